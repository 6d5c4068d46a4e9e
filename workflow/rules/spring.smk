# Study -> force histories of the spring model, all cases of a variant in one job.
rule spring:
    input:
        study=STUDY,
        data=DATA_FILES,
    output:
        histories=expand(f"{RESULTS}/spring/{{{{variant}}}}/{{case}}.csv", case=CASES),
        summary=f"{RESULTS}/spring/{{variant}}/summary.csv",
    log:
        "logs/spring-{variant}.log",
    benchmark:
        "logs/benchmarks/spring-{variant}.tsv"
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards, output: str(Path(output.summary).parent),
    message:
        "Running the spring model {wildcards.variant}"
    shell:
        "tread-validate spring {input.study} --all --variant {wildcards.variant} -o {params.folder} > {log} 2>&1"
