# Study -> force histories of the spring model, all cases of all variants in one job: most of a variant's time would be that
# of starting.
rule spring:
    input:
        study=STUDY,
        data=DATA_FILES,
    output:
        histories=expand(
            f"{RESULTS}/spring/{{variant}}/{{case}}.csv", variant=VARIANTS, case=CASES
        ),
        summary=expand(f"{RESULTS}/spring/{{variant}}/summary.csv", variant=VARIANTS),
    log:
        f"{LOGS}/spring.log",
    benchmark:
        f"{LOGS}/benchmarks/spring.tsv"
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards: str(
            Path(RESULTS, "spring", *(VARIANTS if len(VARIANTS) == 1 else ()))
        ),
        variants=[f"--variant {variant}" for variant in VARIANTS],
        code=VARIANT_CODE,
    message:
        "Running the spring models"
    shell:
        "tread-validate spring {input.study} --all {params.variants} -o {params.folder} > {log} 2>&1"
