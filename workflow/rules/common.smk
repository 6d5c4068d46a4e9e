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
STORE = f"{REFERENCES}/fe/{ENGINE}"
ENVIRONMENT = "../envs/tread_validate.yaml"
REPORT_PAGE = f"{REPORTS}/index.html"
REPORT_PDF = f"{REPORTS}/report.pdf"


wildcard_constraints:
    case=r"[a-z0-9-]+",
    variant=r"[a-z][a-z0-9_]*",
    size=r"[0-9]+p[0-9]+",


def stale_histories(wildcards):
    listed = Path(checkpoints.stale_references.get().output[0]).read_text().split()
    return expand(f"{RESULTS}/fe/{ENGINE}/{{case}}.csv", case=listed)
