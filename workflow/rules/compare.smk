# Histories and references -> rows, tables, regressions, verdicts; and the distance to the accepted baseline.
REFERENCE_FILES = sorted(
    str(path)
    for path in Path(REFERENCES).glob("fe/**/*")
    if path.suffix in (".csv", ".yaml")
)


# Only a baseline of this study says anything about its tables; without one nothing is checked.
BASELINE = Path(REPORTS) / "baseline" / "baseline.yaml"
CHECKED = BASELINE.is_file() and f"study: {study.model.name}\n" in BASELINE.read_text()
LADDER_FILES = sorted(str(path) for path in Path(REFERENCES).glob("ladder/*.csv"))


rule tables:
    input:
        study=STUDY,
        histories=expand(
            f"{RESULTS}/spring/{{variant}}/{{case}}.csv", variant=VARIANTS, case=CASES
        ),
        decks=rules.decks.output.inp,
        references=REFERENCE_FILES,
        package=rules.references.input.package,
        checked=rules.references.output,
    output:
        errors=f"{RESULTS}/tables/errors.csv",
        regression=f"{RESULTS}/tables/regression.csv",
        claims=f"{RESULTS}/tables/claims.csv",
    log:
        "logs/tables.log",
    benchmark:
        "logs/benchmarks/tables.tsv"
    conda:
        ENVIRONMENT
    params:
        spring=lambda wildcards, input: Path(input.histories[0]).parents[1],
        references=lambda wildcards, input: Path(input.package).parent,
        decks=lambda wildcards, input: Path(input.decks[0]).parents[1],
        folder=lambda wildcards, output: Path(output.errors).parent,
    message:
        "Comparing every run with its reference"
    shell:
        "tread-validate tables {input.study} --spring {params.spring} --references {params.references} "
        "--decks {params.decks} -o {params.folder} > {log} 2>&1"


rule check:
    input:
        errors=rules.tables.output.errors,
        baseline=BASELINE,
    output:
        delta=f"{RESULTS}/check/delta.csv",
        markdown=f"{RESULTS}/check/delta.md",
        junit=f"{RESULTS}/check/junit.xml",
    log:
        "logs/check.log",
    benchmark:
        "logs/benchmarks/check.tsv"
    conda:
        ENVIRONMENT
    params:
        tables=lambda wildcards, input: Path(input.errors).parent,
        folder=lambda wildcards, input: Path(input.baseline).parent,
    message:
        "Measuring the distance to the accepted baseline"
    shell:
        "tread-validate check {params.tables} --baseline {params.folder} -o {output.delta} "
        "--markdown {output.markdown} --junit {output.junit} --report-only > {log} 2>&1"
