# The study, read and validated before any job; its workspace; the digests of the code behind each step. A rule has the
# digest of its code among its parameters: after an edit just what depends on it runs again, and so it does when the
# edit is taken back.
import os
import re
import time
from pathlib import Path

from snakemake.exceptions import WorkflowError
from tread_validate.errors import InputError
from tread_validate.models.code import code_of
from tread_validate.models.trust import require_trust
from tread_validate.reference import ENGINE_PARTS
from tread_validate.source_code import code_digest
from tread_validate.spring.variants import code_digest as variant_code
from tread_validate.study import load_study
from tread_validate.study.library import library_file, library_names
from tread_validate.study.typical import path_and_block, typical_cases
from tread_validate.workspace import bind

# when this run began, by which the page of run times tells a time of this run from one of an earlier run
os.environ.setdefault("TREAD_VALIDATE_RUN_BEGAN", f"{time.time():.3f}")
STUDY = config["study"]
REFERENCES = config["references"]
SETTINGS = config["engines"]

try:
    study = load_study(STUDY)
    STUDY_CASES = study.cases()
    NAME = study.model.name
    DECKS, RESULTS, REPORTS, LOGS = (
        f"{config[place]}/{NAME}" for place in ("decks", "results", "reports", "logs")
    )
    bind(Path(RESULTS), Path(STUDY))
    VARIANTS = list(study.model.spring.variants)
    VARIANT_CODE = {variant: variant_code(variant) for variant in VARIANTS}
except InputError as error:
    raise WorkflowError(str(error)) from None

CASES = [case.case_id for case in STUDY_CASES]
DATA_FILES = sorted(
    {str(path) for case in STUDY_CASES for path in case.input_files()}
    | {str(path) for path in study.library_files()}
)
LIBRARY_FILES = [
    str(library_file(name, study.root)) for name in library_names(study.root)
]
ENGINE = study.model.engine
RUNS = {
    "embedded": "fe",
    "calculix": "calculix",
    "abaqus": f"abaqus --settings {SETTINGS}",
}
CODE = {part: code_digest(part) for part in ("deck", "compare", "hierarchy", "report")}
ENGINE_CODE = {engine: code_digest(part) for engine, part in ENGINE_PARTS.items()}
REFERENCE_FILES = sorted(
    str(path)
    for path in Path(REFERENCES).glob("fe/**/*")
    if path.suffix in (".csv", ".yaml", ".txt")
)
# the mesh study: one typical case of every kind of path and block, on three meshes
MESH_CASES = [case.case_id for case in typical_cases(STUDY_CASES, path_and_block)]
MESHES = {"coarse": 2.0, "medium": 1.0, "fine": 0.5}
BASELINE = Path(REPORTS) / "baseline" / "baseline.yaml"
ENVIRONMENT = "../envs/tread_validate.yaml"
REPORT_PAGE = f"{REPORTS}/index.html"
REPORT_PDF = f"{REPORTS}/report.pdf"


wildcard_constraints:
    case=r"[a-z0-9-]+",
    variant=r"[a-z][a-z0-9_]*",
    model=r"[a-z][a-z0-9_]*",
    mesh=r"coarse|medium|fine",


def stale_histories(wildcards):
    listed = Path(checkpoints.stale_references.get().output[0]).read_text().split()
    return expand(f"{RESULTS}/fe/{ENGINE}/{{case}}.csv", case=listed)


stale_histories.needs = ("stale_references", "fe")


def mesh_in_use(wildcards):
    """The mesh of a case's deck: the study's, or that of its path."""
    return next(case.deck for case in STUDY_CASES if case.case_id == wildcards.case)


def mesh_options(wildcards):
    deck, factor = mesh_in_use(wildcards), MESHES[wildcards.mesh]
    if deck.layers % 2 or deck.layers < 4:
        raise WorkflowError(
            f"{STUDY}: layers of {wildcards.case}: got {deck.layers}, expected an even number of 4 or more for a mesh study: "
            "the coarse mesh has half of it"
        )
    return f"--element-size {deck.element_size_mm * factor:g} --layers {round(deck.layers / factor)}"


def pattern(file):
    """A file's pattern without the constraints of its wildcards."""
    return re.sub(r"{(\w+),[^}]*}", r"{\1}", str(file))


def makes(outputs, items):
    """Whether a rule makes an input of another; names are compared as sets, for there may be thousands."""
    names = {pattern(item) for item in items if not callable(item)}
    if names & {pattern(output) for output in outputs}:
        return True
    open_outputs = [output for output in outputs if "{" in str(output)]
    open_items = [item for item in items if not callable(item) and "{" in str(item)]
    tried = {re.sub(r"{\w+}", "x", name) for name in names} if open_outputs else ()
    return any(output.match(name) for output in open_outputs for name in tried) or any(
        item.match(output) for item in open_items for output in outputs
    )


def rule_lines(wildcards):
    """One line a rule: its name, the rules whose files it reads, where its run times are kept."""
    rules_shown = [
        one
        for one in workflow.rules
        if one.name not in ("all", "checked", "rule_graph", "run_times")
        and (MODELS or one.name != "model")
    ]
    lines = []
    for one in rules_shown:
        needs = {name for item in one.input for name in getattr(item, "needs", ())}
        needs |= {other.name for other in rules_shown if makes(other.output, one.input)}
        told = ",".join(sorted(needs - {one.name}))
        lines.append(f"{one.name};{told};{pattern(one.benchmark or '')}")
    return lines
