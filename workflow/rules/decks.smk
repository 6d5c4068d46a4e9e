# Study -> ABAQUS/Explicit decks with their friction routine, all cases in one job.
rule decks:
    input:
        study=STUDY,
        data=DATA_FILES,
    output:
        inp=expand(f"{DECKS}/{{case}}/{{case}}.inp", case=CASES),
        user=expand(f"{DECKS}/{{case}}/vfric.f", case=CASES),
        mesh=expand(f"{DECKS}/{{case}}/mesh.vtu", case=CASES),
    log:
        f"{LOGS}/decks.log",
    benchmark:
        f"{LOGS}/benchmarks/decks.tsv"
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards: DECKS,
        code=CODE["deck"],
    message:
        "Writing the decks of all cases"
    shell:
        "tread-validate deck {input.study} --all -o {params.folder} > {log} 2>&1"
