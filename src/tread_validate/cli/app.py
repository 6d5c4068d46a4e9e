"""`tread-validate`: its verbs, and the exit codes they end with.

0 done; 1 the check ran and failed; 2 wrong input; 3 an engine failed.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Sequence
from typing import Any

import typer

from ..errors import CheckFailedError, EngineError, InputError, TreadValidateError, one_line

# every matrix here is small: threads of the linear algebra library would only wait for each other
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

EXIT_DONE, EXIT_FAILED, EXIT_INPUT, EXIT_ENGINE = 0, 1, 2, 3

# verb -> module under cli/ that holds its `command`; in the order in which a newcomer meets them
VERBS = {
    "cases": "cases",
    "case": "case",
    "deck": "deck",
    "lint": "lint",
    "fe": "fe",
    "spring": "spring",
    "compare": "compare",
    "regress": "regress",
    "tables": "tables",
    "report": "report",
    "check": "check",
    "accept": "accept",
    "ladder": "ladder",
    "fit-prony": "fit_prony",
    "fit-friction": "fit_friction",
    "import-belt": "import_belt",
    "import-rig": "import_rig",
    "import-abaqus": "import_abaqus",
    "synthesize": "synthesize",
    "stimulus": "stimulus",
    "abaqus": "abaqus",
    "calculix": "calculix",
    "engines": "engines",
    "references": "references",
    "stale": "stale",
    "mesh-error": "mesh_error",
    "file-references": "file_references",
    "schema": "schema",
}


class _Verbs(typer.core.TyperGroup):
    """Import a verb's module only when the verb is used, so that every call starts fast."""

    def list_commands(self, ctx: Any) -> list[str]:
        return list(VERBS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in VERBS:
            return None
        module = importlib.import_module(f"tread_validate.cli.{VERBS[cmd_name]}")
        single = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
        single.command(name=cmd_name, no_args_is_help=False)(module.command)
        command = typer.main.get_command(single)
        command.name = cmd_name
        return command


app = typer.Typer(
    cls=_Verbs,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="How far can a tread-block model be trusted? Decks, spring models, an FE engine and their comparison.",
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
)


@app.callback()
def _main() -> None:
    """Hold the verbs together."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit with its code."""
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def run(arguments: Sequence[str]) -> int:
    """Run one verb and return its exit code; every expected fault is one line on standard error."""
    try:
        app(args=list(arguments), prog_name="tread-validate")
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else EXIT_DONE
    except InputError as error:
        return _say(error, EXIT_INPUT)
    except CheckFailedError as error:
        return _say(error, EXIT_FAILED)
    except EngineError as error:
        return _say(error, EXIT_ENGINE)
    except TreadValidateError as error:
        return _say(error, EXIT_INPUT)
    except OSError as error:
        return _say(f"{error.filename or 'file'}: {error.strerror or error}", EXIT_INPUT)
    return EXIT_DONE


def _say(message: object, code: int) -> int:
    print(f"tread-validate: {one_line(str(message))}", file=sys.stderr)
    return code


if __name__ == "__main__":
    main()
