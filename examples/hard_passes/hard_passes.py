"""Run the passes of study.yaml in FE and in `condensed`, and write what came out into docs/hard_passes.md.

Usage: python examples/hard_passes/hard_passes.py [PAGE] (ten minutes on one core; without PAGE the table is printed)
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from tread_validate import deck, fe, load_study, spring
from tread_validate.compare import compare
from tread_validate.compare.quantities.scalars import scalars
from tread_validate.compare.quantities.statistics import statistics
from tread_validate.history import History
from tread_validate.source_code import code_digest
from tread_validate.spring.variants import code_digest as model_digest
from tread_validate.study import Case

MARKS = ("<!-- table -->", "<!-- /table -->")
HEAD = (
    "| Pass | mesh, mm | | N, N | impulse, N s | T+, N | T-, N | ISO N, T | mean T, N |"
    " energy: open, hourglass, impacts, % | `alternation`, % | FE a reference; `condensed` within 2 % N, 3 % impulse,"
    " 3 % or 1 N of T |\n" + "|---" * 12 + "|"
)
WORDS = {
    "scatters": "T scatters",
    "chatter": "chatter",
    "impacts": "impacts",
    "artificial": "hourglass",
    "open": "energy",
}


def meshed(case: Case, size: float) -> Case:
    """Return the case with elements of `size` (mm) along, across and over the height."""
    layers = round(1e3 * case.height / size)
    return replace(case, deck=case.deck.model_copy(update={"element_size_mm": size, "layers": layers}))


def run_fe(case: Case) -> fe.FeResult:
    """Write the deck of a case and run it."""
    with tempfile.TemporaryDirectory() as folder:
        deck.write(case, Path(folder))
        path = Path(folder) / f"{case.case_id}.inp"
        return fe.run_deck(path, path.with_name("vfric.f"))


def forces(history: History) -> tuple[float, float, float, float]:
    """Return the peak of N (N), its impulse (N s) and both peaks of T (N)."""
    found = scalars(history)
    return (
        found.peak_normal_force, found.normal_impulse, found.peak_positive_tangential_force,
        found.peak_negative_tangential_force,
    )  # fmt: skip


def within(reference: tuple[float, ...], predicted: tuple[float, ...]) -> str:
    """Return "yes", or what is further off than 2 % (N), 3 % (impulse) and 3 % or 1 N (peaks of T)."""
    names = ("N", "impulse", "T+", "T-")
    allowed = [0.02 * reference[0], 0.03 * reference[1], *(max(0.03 * abs(peak), 1.0) for peak in reference[2:])]
    far = [
        f"{name} {100.0 * (b / a - 1.0):+.1f} %" if name in names[:2] or abs(a) > 1.0 else f"{name} {b - a:+.1f} N"
        for name, a, b, most in zip(names, reference, predicted, allowed, strict=True)
        if abs(b - a) > most
    ]
    return ", ".join(far) or "yes"


def printed(values: tuple[float, ...], history: History) -> str:
    """Return the cells of the forces."""
    normal, impulse, most, least = values
    return f"{normal:.1f} | {impulse:.4g} | {most:.1f} | {least:.1f} | {{}} | {statistics(history).mean_tangential:.2f}"


def reference(result: fe.FeResult) -> str:
    """Return "yes", or "no" and why the run is no reference."""
    reasons = result.record["reference_quality"]["reasons"]
    why = [short for word, short in WORDS.items() if any(word in reason for reason in reasons)]
    return f"no: {', '.join(why)}" if reasons else "yes"


def rows(case: Case, sizes: tuple[float, ...]) -> list[str]:
    """Return the table's rows of one pass: FE on every mesh, then the model, held against the finest."""
    found, name = [], case.case_id.split("-")[0]
    for size in sizes:
        result = run_fe(meshed(case, size))
        balance = result.record["energy_balance"]
        shares = ", ".join(f"{100.0 * balance[k]:.2g}" for k in ("balance_error", "artificial_share", "impact_share"))
        cells = printed(forces(result.history), result.history).format("")
        chatter = f"{100.0 * result.record['alternation']:.2g}"
        found.append(f"| {name} | {size:g} | FE | {cells} | {shares} | {chatter} | {reference(result)} |")
        print(found[-1], flush=True)
    model = spring.run(case, "condensed")
    scores = {row.quantity: row.predicted for row in compare(result.history, model) if row.metric == "iso18571_r"}
    grades = f"{scores['normal_force']:.2f}, {scores['tangential_force']:.2f}"
    judged = within(forces(result.history), forces(model))
    if reference(result) != "yes":
        judged = f"not judged ({judged})"
    wary = "; it says: no reliable history" if "no reliable" in model.provenance.get("caution", "") else ""
    cells = printed(forces(model), model).format(grades)
    found.append(f"| | | `condensed` | {cells} | | | {judged}{wary} |")
    print(found[-1], flush=True)
    return found


def written_between(page: Path, marks: tuple[str, str], table: str) -> None:
    """Write a table between two marks of a page, in place of what stood there."""
    text = page.read_text(encoding="utf-8")
    before, after = text.split(marks[0])[0], text.split(marks[1])[1]
    page.write_text(f"{before}{marks[0]}\n{table}\n{marks[1]}{after}", encoding="utf-8")


def write_or_print(marks: tuple[str, str], table: str) -> None:
    """Write a table into the page that the command line names, or print it."""
    if len(sys.argv) > 1:
        written_between(Path(sys.argv[1]), marks, table)
    else:
        print(table)


def main() -> None:
    """Run every pass and write the table."""
    study = Path(__file__).with_name("study.yaml")
    lines = []
    for case in spring.resolve_creep(load_study(study).cases()):
        lines += rows(case, (2.0, 1.0, 0.5) if case.height < 5e-3 else (1.0,))
    codes = f"FE engine {code_digest('fe')[:12]}, `condensed` {model_digest('condensed')[:12]}"
    table = "\n".join([HEAD, *lines, "", f"Made by the code {codes}."])
    write_or_print(MARKS, table)


if __name__ == "__main__":
    main()
