"""`tread-validate stimulus`: the excitation of a tyre by its tread pattern."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .options import number

if TYPE_CHECKING:
    from ..history import History
    from ..stimulus.pitch import RibBlocks
    from ..study import Case, LoadedStudy


_Study = Annotated[Path, typer.Argument(help="study file (YAML)")]
_CaseId = Annotated[str, typer.Option("--case", help="a belt case of the study")]
_Pitch = Annotated[Path, typer.Option("--pitch", help="pitch sequence (YAML): block lengths and gaps, rib by rib")]
_Output = Annotated[Path, typer.Option("-o", "--output", help="folder for the results")]
_Variant = Annotated[
    list[str] | None,
    typer.Option("--variant", help="spring variant; the study's where neither this nor --model is given"),
]
_Model = Annotated[
    list[str] | None, typer.Option("--model", help="a model of the study's own, run on each size of block")
]
_TrustModels = Annotated[
    bool, typer.Option("--trust-models", help="run what the study names as command or Python object")
]
_History = Annotated[
    list[str] | None,
    typer.Option("--history", help="LABEL=FILE.csv: a block history of your own (FE, measured), any number"),
]
_ImpulseResponse = Annotated[Path | None, typer.Option("--impulse-response", help="CSV time_s,to_normal,to_tangential")]
_TransferFunction = Annotated[
    Path | None, typer.Option("--transfer-function", help="CSV frequency_Hz and complex ratios to both forces")
]
_ToHz = Annotated[
    float,
    number("--to", "highest_frequency_Hz", "highest frequency of the spectrum, Hz"),
]


def command(
    study: _Study,
    case_id: _CaseId,
    pitch: _Pitch,
    output: _Output,
    variant: _Variant = None,
    model: _Model = None,
    trust_models: _TrustModels = False,
    history: _History = None,
    impulse_response: _ImpulseResponse = None,
    transfer_function: _TransferFunction = None,
    to_hz: _ToHz = 1000.0,
) -> None:
    """Add up the forces of every block round the tyre: time signal, spectrum to 1 kHz, response of a belt or hub.

    Example: tread-validate stimulus config/study.yaml --case belt-simplified-60c-0p2mm-16p7mps-creep0p3 \
    --pitch examples/own_study/pitch.yaml -o results/stimulus
    """
    from .. import provenance, spring
    from ..errors import InputError
    from ..stimulus import load_pitch_sequence, read_impulse_response, read_transfer_function, respond, superpose
    from ..stimulus.blocks import belt_case
    from ..stimulus.output import draw, write, write_summary
    from ..study import load_study

    loaded = load_study(study)
    case = loaded.case(case_id)
    if case.creep_ratio is None and case.path.on_tyre:
        (case,) = spring.resolve_creep((case,))
    case = belt_case(case)
    sequence = load_pitch_sequence(pitch)
    if impulse_response is not None and transfer_function is not None:
        raise InputError("--transfer-function", "an impulse response too", "one of the two")
    path = None
    if impulse_response is not None:
        path = read_impulse_response(impulse_response)
    elif transfer_function is not None:
        path = read_transfer_function(transfer_function)

    chosen = variant or (() if model else loaded.model.spring.variants)
    sources = _sources(loaded, case, chosen, model or (), history or (), trusted=trust_models)
    assumed = "; ".join((*case.assumed(), *_marked(sequence.origin, sequence.name)))
    stimuli = []
    for label, history_of in sources.items():
        notes = {
            "case_id": case.case_id,
            "producer": f"stimulus/{label}",
            "version": provenance.version(),
            "commit": provenance.commit(),
            "pitch_sequence": sequence.name,
            "pitch_sha256": provenance.sha256_file(pitch),
            "study_digest": loaded.digest,
            "assumed": assumed,
        }
        stimulus = superpose(sequence, case.speed, history_of, label=label, highest_frequency=to_hz, provenance=notes)
        write(stimulus, None if path is None else respond(stimulus, path), output / label)
        stimuli.append(stimulus)
        typer.echo(
            f"{label}: mean normal force {stimulus.mean_normal_force:.2f} N, mean longitudinal force "
            f"{stimulus.mean_tangential_force:.3f} N, block passing "
            + ", ".join(f"{rib} {rate:.2f} Hz" for rib, rate in stimulus.block_rates.items())
        )
    write_summary(stimuli, output / "summary.csv")
    draw(stimuli, output / "stimulus.png", assumed)
    if assumed:
        typer.echo(f"assumed or synthetic inputs: {assumed}")


def _sources(
    study: LoadedStudy,
    case: Case,
    variants: Sequence[str],
    models: Sequence[str],
    histories: Sequence[str],
    *,
    trusted: bool,
) -> dict[str, Callable[[RibBlocks], History]]:
    """Return, by its label, what gives the history of a block of any length: variants, models, the user's files."""
    from functools import partial

    from .. import spring
    from ..errors import InputError
    from ..history import History
    from ..stimulus.blocks import by_history, by_model

    sources: dict[str, Callable[[RibBlocks], History]] = {}
    for name in variants:
        sources[name] = by_model(case, partial(spring.run, variant=name))
    for name in models:
        if name in sources:
            raise InputError("--model", f"{name}, the name of a variant too", "a name of its own")
        sources[name] = by_model(case, partial(_own, study, name, trusted=trusted))
    for item in histories:
        label, equals, file = item.partition("=")
        if not equals or not label.replace("_", "").replace("-", "").isalnum():
            raise InputError("--history", item, "LABEL=FILE.csv, the label of letters, digits, - and _")
        if label in sources:
            raise InputError("--history", f"label {label} again", "a label of its own")
        sources[label] = by_history(case, History.read_csv(file), file)
    return sources


def _own(study: LoadedStudy, name: str, case: Case, *, trusted: bool) -> History:
    """Run a model of the study's own; it must give both forces."""
    from ..errors import InputError
    from ..models.single import history_of

    history = history_of(study, name, case, trusted=trusted)
    if not history.gives_tangential:
        raise InputError(f"model {name}", "no longitudinal force", "both forces: the stimulus is made of both")
    return history


def _marked(origin: str, name: str) -> tuple[str, ...]:
    return (f"pitch sequence {name} ({origin})",) if origin in ("assumed", "synthetic") else ()
