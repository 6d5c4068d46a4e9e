# From a study to decks, spring runs, comparison and report. `make report` runs this; see workflow/rules.
from snakemake.utils import min_version, validate

min_version("9.0")


configfile: "config/workflow.yaml"


validate(config, "workflow/schemas/workflow.schema.yaml")


include: "workflow/rules/common.smk"
include: "workflow/rules/decks.smk"
include: "workflow/rules/spring.smk"
include: "workflow/rules/models.smk"
include: "workflow/rules/fe.smk"
include: "workflow/rules/compare.smk"
include: "workflow/rules/mesh.smk"
include: "workflow/rules/hierarchy.smk"
include: "workflow/rules/graph.smk"
include: "workflow/rules/report.smk"


localrules:
    all,
    checked,
    rule_graph,
    run_times,


rule all:
    default_target: True
    input:
        rules.tables.output.errors,
        REPORT_PAGE,
        REPORT_PDF,
        rules.run_times.output,
