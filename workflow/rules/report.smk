# Tables -> one HTML page, one PDF.
rule report:
    input:
        study=STUDY,
        errors=rules.tables.output.errors,
        delta=CHECKED,
        histories=rules.tables.input.histories,
        decks=rules.decks.output.mesh,
        graph=rules.rule_graph.output,
        references=REFERENCE_FILES,
        hierarchy=sorted(
            str(path) for path in Path(REFERENCES, "hierarchy", NAME).glob("*.*")
        ),
    output:
        page=report(
            REPORT_PAGE, caption="../report/page.rst", category="Validation report"
        ),
        pdf=report(
            REPORT_PDF, caption="../report/pdf.rst", category="Validation report"
        ),
    log:
        f"{LOGS}/report.log",
    benchmark:
        f"{LOGS}/benchmarks/report.tsv"
    conda:
        ENVIRONMENT
    threads: 2
    params:
        tables=lambda wildcards: f"{RESULTS}/tables",
        spring=lambda wildcards: f"{RESULTS}/spring",
        references=lambda wildcards: REFERENCES,
        decks=lambda wildcards: DECKS,
        delta=lambda wildcards, input: f"--delta {input.delta}" if input.delta else "",
        folder=lambda wildcards: REPORTS,
        code=[CODE["report"], CODE["hierarchy"]],
    message:
        "Writing the report"
    shell:
        "tread-validate report {input.study} --tables {params.tables} --spring {params.spring} "
        "--references {params.references} --decks {params.decks} --workflow {input.graph} {params.delta} "
        "--jobs {threads} -o {params.folder} > {log} 2>&1"


rule run_times:
    input:
        page=rules.report.output.page,
        graph=rules.rule_graph.output,
    output:
        f"{REPORTS}/run_times.html",
    log:
        f"{LOGS}/run_times.log",
    conda:
        ENVIRONMENT
    params:
        code=CODE["report"],
    message:
        "Writing the run times"
    shell:
        "tread-validate run-times {input.graph} -o {output} > {log} 2>&1"
