# Every rung of the model ladder against the FE runs, and the studies around it. Takes minutes, so a report does not wait
# for it: it shows the filed result of the study and says where other conditions or code have made it stale.
rule ladder_tables:
    input:
        study=STUDY,
        data=DATA_FILES,
        decks=rules.decks.output.inp,
        models=expand(rules.model.output.summary, model=MODELS),
        references=REFERENCE_FILES,
    output:
        folder=directory(f"{RESULTS}/ladder"),
    log:
        f"{LOGS}/ladder.log",
    benchmark:
        f"{LOGS}/benchmarks/ladder.tsv"
    conda:
        ENVIRONMENT
    params:
        decks=lambda wildcards: DECKS,
        references=lambda wildcards: REFERENCES,
        models=lambda wildcards: f"{RESULTS}/models",
        code=CODE["ladder"],
    message:
        "Running the model ladder"
    shell:
        "tread-validate ladder {input.study} --decks {params.decks} --references {params.references} "
        "--models {params.models} -o {output.folder} > {log} 2>&1"


rule ladder:
    input:
        rules.ladder_tables.output.folder,
    log:
        f"{LOGS}/ladder-filing.log",
    conda:
        ENVIRONMENT
    params:
        target=lambda wildcards: f"{REFERENCES}/ladder/{NAME}",
    message:
        "Filing the model ladder"
    shell:
        "rm -rf {params.target} && mkdir -p {params.target} && cp -r {input}/. {params.target} > {log} 2>&1"
