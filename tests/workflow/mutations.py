"""Twenty mutations of one line each: is every one that changes a number caught by `make check` without `make clean`?

Usage: python tests/workflow/mutations.py [-o docs/mutations.md] (half an hour on two cores). A small study (a rig and a
belt case, coarse mesh) is run with a copy of the source and its baseline accepted; then each line is changed, checked
and put back. A last check says that the workspace is where it was.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

import yaml

sys.path.insert(0, str(Path(__file__).parent))
from small_study import Small, make_small

MUTATIONS = tuple(
    (item["part"], item["file"], item["old"], item["new"])
    for item in yaml.safe_load(Path(__file__).with_suffix(".yaml").read_text(encoding="utf-8"))
)


def prepared(folder: Path) -> Small:
    """Return the small study with references and an accepted baseline."""
    small = make_small(folder)
    small.study(belt=True)
    for step in (
        small.snakemake("reference"),
        small.snakemake("checked"),
        small.run("tread-validate", "accept", "--reason", "before the mutations", "--who", "check", "--allow-dirty"),
    ):
        if step.returncode != 0:
            raise SystemExit(step.stdout + step.stderr)
    if small.check().returncode != 0:
        raise SystemExit("the baseline moved before anything was changed")
    return small


def tried(small: Small, part: str, file: str, old: str, new: str) -> tuple[str, bool]:
    """Apply one mutation, check, put it back; return a row of the table and whether it was caught."""
    text = small.edit(file, old, new)
    begun = time.monotonic()
    try:
        made = small.snakemake("checked")
        done = small.assessment() if made.returncode == 0 else made
    finally:
        small.restore(file, text)
    seconds = time.monotonic() - begun
    if made.returncode != 0:
        lines = [line for line in (made.stdout + made.stderr).splitlines() if "tread-validate: " in line]
        said = f"stopped: {lines[0].strip()[:110]}" if lines else "stopped"
    else:
        said = done.stdout.splitlines()[-1].removeprefix("baseline: ") + f", exit code {done.returncode}"
    caught = done.returncode in (1, 3) or made.returncode != 0
    print(f"{'caught' if caught else 'MISSED'} {part} {file}: {said} ({seconds:.0f} s)", flush=True)
    shown = new.strip().replace("|", "\\|")
    return (
        f"| {part} | `{file}` | `{shown}` | {'yes' if caught else '**no**'} | {said.replace(' (make check)', '')} |",
        caught,
    )


def main() -> int:
    """Run all mutations and write the table; 1 where one was missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, help="Markdown page to write")
    parser.add_argument("--only", help="text that a mutation's file must have in it")
    choice = parser.parse_args()
    chosen = [mutation for mutation in MUTATIONS if choice.only is None or choice.only in mutation[1]]
    with tempfile.TemporaryDirectory(prefix="mutations-") as folder:
        small = prepared(Path(folder))
        found = [tried(small, *mutation) for mutation in chosen]
        back = small.check().returncode == 0
    caught = sum(row[1] for row in found)
    print(f"{caught} of {len(found)} caught; afterwards the baseline is {'as it was' if back else 'NOT as it was'}")
    if choice.output is not None:
        head = (
            "# Mutations of one line\n\nWritten by `python tests/workflow/mutations.py -o docs/mutations.md`: each"
            " line is changed in a copy of the source,\n`make check` is run without `make clean`, and the line is put"
            f" back. {caught} of {len(found)} were caught; afterwards the\nbaseline is "
            f"{'as it was' if back else 'NOT as it was'}.\n\n"
            "| Part | File | The line after the change | Caught | What the check said |\n|---|---|---|---|---|\n"
        )
        old = choice.output.read_text(encoding="utf-8") if choice.output.is_file() else ""
        second = "".join(old.partition("\n## A second list")[1:])  # tried with more variants: kept as it stands
        choice.output.write_text(head + "".join(f"{row}\n" for row, _ in found) + second, encoding="utf-8")
    return 0 if caught == len(found) and back else 1


if __name__ == "__main__":
    raise SystemExit(main())
