"""`tread-validate`: its verbs, and the exit codes they end with (docs/exit_codes.md)."""

from __future__ import annotations

import importlib
import os
import platform
import sys
import tempfile
import traceback
import warnings
from collections.abc import Sequence
from typing import Annotated, Any

import typer
from typer.exceptions import TyperException

from ..errors import TreadValidateError, one_line
from ..files import protected
from .options import paths_of, refuse_overwriting

EXIT_DONE, EXIT_INPUT, EXIT_UNEXPECTED = 0, 2, 4  # 1 and 3: see the exceptions
EXIT_INTERRUPTED = 130  # as shells count an interrupt from the keyboard

# verb -> module under cli/ that holds its `command`; in the order in which a newcomer meets them
VERBS = {
    "cases": "cases",
    "case": "case",
    "deck": "deck",
    "lint": "lint",
    "fe": "fe",
    "spring": "spring",
    "model": "model",
    "new-model": "new_model",
    "compare": "compare",
    "regress": "regress",
    "tables": "tables",
    "report": "report",
    "run-times": "run_times",
    "check": "check",
    "check-model": "check_model",
    "accept": "accept",
    "assessment": "assessment",
    "badge": "badge",
    "hierarchy": "hierarchy",
    "map": "map",
    "fit-prony": "fit_prony",
    "fit-friction": "fit_friction",
    "import-belt": "import_belt",
    "import-rig": "import_rig",
    "import-abaqus": "import_abaqus",
    "strain-effect": "strain_effect",
    "synthesize": "synthesize",
    "stimulus": "stimulus",
    "abaqus": "abaqus",
    "calculix": "calculix",
    "engines": "engines",
    "references": "references",
    "stale": "stale",
    "mesh-error": "mesh_error",
    "file-references": "file_references",
    "run-references": "run_references",
    "migrate-references": "migrate_references",
    "schema": "schema",
}


class _Verbs(typer.core.TyperGroup):
    """Import a verb's module only when the verb is used, so that every call starts fast."""

    def list_commands(self, ctx: Any) -> list[str]:
        return list(VERBS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in VERBS:
            return None
        return verb(cmd_name)


def verb(name: str) -> Any:
    """Return a verb as a command; what it reads cannot be what it writes."""
    module = importlib.import_module(f"tread_validate.cli.{VERBS[name]}")
    single = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
    single.command(name=name, no_args_is_help=False)(module.command)
    command = typer.main.get_command(single)
    command.name = name
    inner = command.callback
    assert inner is not None

    def guarded(**values: Any) -> Any:
        read, written = paths_of(command, values)
        refuse_overwriting(read, written)
        with protected(read):
            return inner(**values)

    command.callback = guarded
    return command


app = typer.Typer(
    cls=_Verbs,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="How far can a tread-block model be trusted? Decks, spring models, an FE engine and their comparison.",
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
)


def _version(wanted: bool) -> None:
    if wanted:
        from ..provenance import commit, version

        typer.echo(f"tread-validate {version()}, code {commit()}")
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="print version and commit, and end")
    ] = False,
) -> None:
    """Hold the verbs together."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit with its code."""
    warnings.showwarning = say_warning
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def say_warning(message: Warning | str, *_of: Any, **_more: Any) -> None:
    """Say a warning in one line, without the place in the code that a user cannot change."""
    typer.echo(f"tread-validate: warning: {one_line(str(message), 200)}", err=True)


def run(arguments: Sequence[str]) -> int:
    """Run one verb and return its exit code; every fault is one line on standard error."""
    try:
        code = app(args=list(arguments), prog_name="tread-validate", standalone_mode=False)
    except TyperException as error:
        return _say(f"{_told(error)} (--help shows what there is)", EXIT_INPUT)
    except (typer.Abort, KeyboardInterrupt):
        return _say("interrupted", EXIT_INTERRUPTED)
    except TreadValidateError as error:
        return _say(error, error.exit_code)
    except BrokenPipeError:  # the reader of our output, such as `head`, has seen enough
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  # open until the process ends
        return EXIT_DONE
    except OSError as error:
        return _say(f"{error.filename or 'file'}: {error.strerror or error}", EXIT_INPUT)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else EXIT_DONE
    except Exception as error:
        return _say(f"{type(error).__name__}: {one_line(str(error), 160)}; a fault of the program, told in full in "
                    f"{_log(arguments)}", EXIT_UNEXPECTED)  # fmt: skip
    return code if isinstance(code, int) else EXIT_DONE


def _told(error: TyperException) -> str:
    return str(error.format_message()) if hasattr(error, "format_message") else str(error)


def _log(arguments: Sequence[str]) -> str:
    """Write the exception being handled to a log file and return its path."""
    from ..provenance import commit, version

    with tempfile.NamedTemporaryFile(
        "w", encoding="utf-8", prefix="tread-validate-", suffix=".log", delete=False
    ) as stream:
        stream.write(f"tread-validate {version()}, code {commit()}, Python {platform.python_version()}, ")
        stream.write(f"{platform.platform()}\narguments: {list(arguments)!r}\nfolder: {os.getcwd()}\n")
        stream.write(traceback.format_exc())
    return stream.name


def _say(message: object, code: int) -> int:
    print(f"tread-validate: {one_line(str(message))}", file=sys.stderr)
    return code


if __name__ == "__main__":
    main()
