# The study, read and validated before any job; names that the rules share.
from pathlib import Path

from snakemake.exceptions import WorkflowError
from tread_validate.errors import InputError
from tread_validate.study import load_study

STUDY = config["study"]
DECKS = config["decks"]
RESULTS = config["results"]
REFERENCES = config["references"]
REPORTS = config["reports"]

try:
    study = load_study(STUDY)
    CASES = [case.case_id for case in study.cases()]
    DATA_FILES = sorted(
        {str(path) for case in study.cases() for path in case.input_files()}
    )
except InputError as error:
    raise WorkflowError(str(error)) from None

VARIANTS = list(study.model.spring.variants)
ENGINE = study.model.engine
MESH_ERRORS = f"{REFERENCES}/fe/mesh"
# the mesh study: element size in the file name -> layers over the height, and the two cases it is made with
MESH_LAYERS = {"2p0": 4, "1p0": 8, "0p5": 16}
MESH_CASES = {
    "rig": "rig-rectangle-22c-0p2mm-300rpm",
    "belt": "belt-simplified-60c-0p2mm-16p7mps-creep0p3",
}
ENVIRONMENT = "../envs/tread_validate.yaml"
REPORT_PAGE = f"{REPORTS}/index.html"
REPORT_PDF = f"{REPORTS}/report.pdf"


wildcard_constraints:
    case=r"[a-z0-9-]+",
    variant=r"[a-z][a-z0-9_]*",
    size=r"[0-9]+p[0-9]+",
    kind=r"rig|belt",


def stale_histories(wildcards):
    listed = Path(checkpoints.stale_references.get().output[0]).read_text().split()
    return expand(f"{RESULTS}/fe/embedded/{{case}}.csv", case=listed)
