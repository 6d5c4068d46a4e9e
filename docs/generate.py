"""Write the pages of the guide that come from the code and from the pipeline: docs/generated/.

Usage: python docs/generate.py [--draft]. Run by `make docs` after the report, whose tables and figures it takes; a
figure or table that is not there fails the build. A draft says so in its place, to check the links without a report.
"""

from __future__ import annotations

import csv
import json
import shutil
import sys
from pathlib import Path

from api_page import api_page

from tread_validate.files import write_text
from tread_validate.study.reference_page import study_reference
from tread_validate.validity.made_by import record
from tread_validate.validity.summary import summary
from tread_validate.validity.table import committed
from tread_validate.workspace import Workspace

ROOT = Path(__file__).resolve().parents[1]
OUT = ROOT / "docs" / "generated"
PAPER = Workspace("liu2010", ROOT)
STUDY = "liu2010"
TABLES = ROOT / "results" / STUDY / "tables"
FIGURES = (
    "rig-sketch", "belt-sketch", "moduli-surrogate", "friction-road", "belt-heights", "belt-curvature",
    "rig-histories-22c-normal", "rig-histories-22c-tangential", "peaks-rectangle-22c", "peaks-parallelogram-22c",
    "belt-histories-simplified-normal", "belt-histories-simplified-tangential", "coefficient-a-v",
    "coefficient-a-theta",
)  # fmt: skip
NOT_MADE = "not made yet: run `make report`, then `make docs`"


def there(path: Path) -> bool:
    """Return whether a file of the report has been made; outside a draft it must have been."""
    if path.is_file() or "--draft" in sys.argv:
        return path.is_file()
    sys.exit(f"{path.relative_to(ROOT)}: {NOT_MADE}")


def rows(name: str) -> list[dict[str, str]]:
    """Return the rows of a table of the pipeline; none in a draft without it."""
    path = TABLES / name
    if not there(path):
        return []
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def table(columns: dict[str, str], items: list[dict[str, str]]) -> str:
    """Return a Markdown table of some columns."""
    if not items:
        return NOT_MADE
    lines = ["| " + " | ".join(columns.values()) + " |", "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(item[key].replace("|", "\\|") for key in columns) + " |" for item in items]
    return "\n".join(lines)


def figure(name: str, caption: str) -> str:
    """Return an image of the report, or words in its place."""
    source = ROOT / "reports" / STUDY / "figures" / f"{name}.svg"
    if not there(source):
        return f"*{caption}: {NOT_MADE}.*"
    shutil.copyfile(source, OUT / source.name)
    return f"![{caption}]({source.name})\n\n*{caption}*"


def walkthrough() -> str:
    """Return the paper's study, step by step, with the pictures of the last report."""
    template = (ROOT / "docs" / "walkthrough.in.md").read_text(encoding="utf-8")
    for name in FIGURES:
        marker = "{{" + name + ": "
        while marker in template:
            start = template.index(marker)
            end = template.index("}}", start)
            template = template[:start] + figure(name, template[start + len(marker) : end]) + template[end + 2 :]
    return template


def validation() -> str:
    """Return the numbers of the last comparison."""
    provenance = TABLES / "provenance.json"
    facts = json.loads(provenance.read_text(encoding="utf-8")) if provenance.is_file() else {}
    ensemble = [row for row in rows("ensemble.csv") if row["quantity"] == "peak_normal_force" and row["group"] == "all"]
    # as the report counts: what a model predicts, not what was put in or made to fit
    claims = [row for row in rows("claims.csv") if row["kind"] == "model" and row["status"] != "not_compared"]
    assessments: dict[str, dict[str, int]] = {}
    for row in claims:
        source = row["source"] or "input"
        assessments.setdefault(source, {}).setdefault(row["assessment"], 0)
        assessments[source][row["assessment"]] += 1
    counted = [
        {"source": source, **{name: str(count.get(name, 0)) for name in ("agrees", "disagrees", "cannot tell")}}
        for source, count in assessments.items()
    ]
    coefficients = [row for row in rows("regression.csv") if row["set"] == "mean"]
    return "\n\n".join(
        [
            "# Validation: the numbers of the last run",
            f"Written by `make docs` from `results/{STUDY}/tables`; code commit "
            f"{facts.get('commit', facts.get('code', {}).get('commit', 'unknown'))}. Verification, which asks whether"
            " the equations are solved rightly, is another question: see the pages on the engine and the models.",
            "## Peak normal force compared with its references, all runs",
            table(
                {
                    "predicted_source": "model",
                    "reference_source": "reference",
                    "compared": "runs compared",
                    "cases": "of",
                    "adequate": "good enough",
                    "mean_abs_error": "mean abs. error",
                    "largest_abs_error": "largest",
                    "status": "status",
                },
                ensemble,
            ),
            "## Speed and temperature coefficients",
            table(
                {
                    "source": "source",
                    "shape": "shape",
                    "coefficient": "coefficient",
                    "value": "value",
                    "unit": "unit",
                    "ci_low": "95 % from",
                    "ci_high": "to",
                    "status": "status",
                },
                coefficients,
            ),
            "## Published statements that a model predicts",
            table(
                {
                    "source": "source",
                    "agrees": "agrees",
                    "disagrees": "disagrees",
                    "cannot tell": "cannot tell",
                },
                counted,
            ),
            "Each statement with its number, and every assumed input behind it, is in the report.",
        ]
    )


def main() -> int:
    """Write the pages."""
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    write_text(OUT / "study_file.md", study_reference())
    write_text(OUT / "api.md", api_page())
    numbers = "# The validity map in numbers\n\n" + summary(committed(), record())
    write_text(OUT / "validity_map_numbers.md", numbers)
    write_text(OUT / "walkthrough.md", walkthrough())
    write_text(OUT / "validation.md", validation() + "\n")
    shutil.copyfile(ROOT / "CHANGELOG.md", OUT / "changelog.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
