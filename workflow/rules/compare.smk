# Histories and references -> rows, tables, regressions, assessments; and the distance to the accepted baseline.
rule references:
    input:
        package=f"{REFERENCES}/datapackage.yaml",
        published=f"{REFERENCES}/published/published.csv",
        runs=REFERENCE_FILES,
    output:
        f"{RESULTS}/references.txt",
    log:
        f"{LOGS}/references.log",
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards: REFERENCES,
    message:
        "Checking the reference data"
    shell:
        "tread-validate references {params.folder} -o {output} > {log} 2>&1"


rule tables:
    input:
        study=STUDY,
        histories=rules.spring.output.histories,
        models=expand(rules.model.output.summary, model=MODELS),
        decks=rules.decks.output.inp,
        references=REFERENCE_FILES,
        checked=rules.references.output,
    output:
        errors=f"{RESULTS}/tables/errors.csv",
        regression=f"{RESULTS}/tables/regression.csv",
        claims=f"{RESULTS}/tables/claims.csv",
    log:
        f"{LOGS}/tables.log",
    benchmark:
        f"{LOGS}/benchmarks/tables.tsv"
    conda:
        ENVIRONMENT
    threads: 2
    params:
        spring=lambda wildcards: f"{RESULTS}/spring",
        references=lambda wildcards: REFERENCES,
        decks=lambda wildcards: DECKS,
        folder=lambda wildcards: f"{RESULTS}/tables",
        code=[CODE["compare"], ENGINE_CODE],
    message:
        "Comparing every run with its reference"
    shell:
        "tread-validate tables {input.study} --spring {params.spring} --references {params.references} "
        "--decks {params.decks} --jobs {threads} -o {params.folder} > {log} 2>&1"


rule check:
    input:
        errors=rules.tables.output.errors,
        baseline=BASELINE,
    output:
        delta=f"{RESULTS}/check/delta.csv",
        markdown=f"{RESULTS}/check/delta.md",
        junit=f"{RESULTS}/check/junit.xml",
    log:
        f"{LOGS}/check.log",
    benchmark:
        f"{LOGS}/benchmarks/check.tsv"
    conda:
        ENVIRONMENT
    params:
        tables=lambda wildcards: f"{RESULTS}/tables",
        folder=lambda wildcards, input: Path(input.baseline).parent,
        code=CODE["compare"],
    message:
        "Measuring the distance to the accepted baseline"
    shell:
        "tread-validate check {params.tables} --baseline {params.folder} -o {output.delta} "
        "--markdown {output.markdown} --junit {output.junit} --report-only > {log} 2>&1"


# What `make report` and `make check` end with: both wait for these.
CHECKED = rules.check.output.delta if BASELINE.is_file() else []


rule checked:
    input:
        rules.tables.output.errors,
        CHECKED,
