# Tables -> one HTML page, one PDF.
rule report:
    input:
        study=STUDY,
        errors=rules.tables.output.errors,
        delta=rules.check.output.delta if CHECKED else [],
        histories=rules.tables.input.histories,
        decks=rules.decks.output.mesh,
        package=rules.references.input.package,
        references=REFERENCE_FILES,
        ladder=LADDER_FILES,
    output:
        page=report(
            REPORT_PAGE, caption="../report/page.rst", category="Validation report"
        ),
        pdf=report(
            REPORT_PDF, caption="../report/pdf.rst", category="Validation report"
        ),
    log:
        "logs/report.log",
    benchmark:
        "logs/benchmarks/report.tsv"
    conda:
        ENVIRONMENT
    params:
        tables=lambda wildcards, input: Path(input.errors).parent,
        spring=lambda wildcards, input: Path(input.histories[0]).parents[1],
        references=lambda wildcards, input: Path(input.package).parent,
        decks=lambda wildcards, input: Path(input.decks[0]).parents[1],
        delta=lambda wildcards, input: f"--delta {input.delta}" if input.delta else "",
        folder=lambda wildcards, output: Path(output.page).parent,
    message:
        "Writing the report"
    shell:
        "tread-validate report {input.study} --tables {params.tables} --spring {params.spring} "
        "--references {params.references} --decks {params.decks} {params.delta} -o {params.folder} > {log} 2>&1"
