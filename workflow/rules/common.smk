# The study, read and validated before any job; its workspace; the digests of the code behind each step. A rule has the
# digest of its code among its parameters: after an edit just what depends on it runs again, and so it does when the
# edit is taken back.
from pathlib import Path

from snakemake.exceptions import WorkflowError
from tread_validate.errors import InputError
from tread_validate.models.code import code_of
from tread_validate.models.trust import require_trust
from tread_validate.reference import ENGINE_PARTS
from tread_validate.source_code import code_digest
from tread_validate.spring.variants import code_digest as variant_code
from tread_validate.study import load_study
from tread_validate.study.typical import path_and_block, typical_cases
from tread_validate.workspace import bind

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
ENGINE = study.model.engine
RUNS = {
    "embedded": "fe",
    "calculix": "calculix",
    "abaqus": f"abaqus --settings {SETTINGS}",
}
CODE = {part: code_digest(part) for part in ("deck", "compare", "ladder", "report")}
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


def mesh_options(wildcards):
    deck, factor = study.model.deck, MESHES[wildcards.mesh]
    if deck.layers % 2 or deck.layers < 4:
        raise WorkflowError(
            f"{STUDY}: deck.layers: got {deck.layers}, expected an even number of 4 or more for a mesh study: "
            "the coarse mesh has half of it"
        )
    return f"--element-size {deck.element_size_mm * factor:g} --layers {round(deck.layers / factor)}"
