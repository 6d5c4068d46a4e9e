# Study -> force histories of the spring model, all cases of a variant in one job.
rule spring:
    input:
        study=STUDY,
        data=DATA_FILES,
    output:
        histories=expand(f"{RESULTS}/spring/{{{{variant}}}}/{{case}}.csv", case=CASES),
        summary=f"{RESULTS}/spring/{{variant}}/summary.csv",
    log:
        f"{LOGS}/spring-{{variant}}.log",
    benchmark:
        f"{LOGS}/benchmarks/spring-{{variant}}.tsv"
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards, output: str(Path(output.summary).parent),
        code=lambda wildcards: VARIANT_CODE[wildcards.variant],
    message:
        "Running the spring model {wildcards.variant}"
    shell:
        "tread-validate spring {input.study} --all --variant {wildcards.variant} -o {params.folder} > {log} 2>&1"
