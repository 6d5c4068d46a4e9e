# Every level of the model hierarchy against the FE runs, and the studies around it. Takes minutes, so a report does not wait
# for it: it shows the filed result of the study and says where other conditions or code have made it stale.
rule hierarchy_tables:
    input:
        study=STUDY,
        data=DATA_FILES,
        compounds=LIBRARY_FILES,
        decks=rules.decks.output.inp,
        models=expand(rules.model.output.summary, model=MODELS),
        references=REFERENCE_FILES,
    output:
        folder=directory(f"{RESULTS}/hierarchy"),
    log:
        f"{LOGS}/hierarchy.log",
    benchmark:
        f"{LOGS}/benchmarks/hierarchy.tsv"
    conda:
        ENVIRONMENT
    params:
        decks=lambda wildcards: DECKS,
        references=lambda wildcards: REFERENCES,
        models=lambda wildcards: f"{RESULTS}/models",
        code=CODE["hierarchy"],
    message:
        "Running the model hierarchy"
    shell:
        "tread-validate hierarchy {input.study} --decks {params.decks} --references {params.references} "
        "--models {params.models} -o {output.folder} > {log} 2>&1"


rule hierarchy:
    input:
        rules.hierarchy_tables.output.folder,
    log:
        f"{LOGS}/hierarchy-filing.log",
    conda:
        ENVIRONMENT
    params:
        target=lambda wildcards: f"{REFERENCES}/hierarchy/{NAME}",
    message:
        "Filing the model hierarchy"
    shell:
        "rm -rf {params.target} && mkdir -p {params.target} && cp -r {input}/. {params.target} > {log} 2>&1"
