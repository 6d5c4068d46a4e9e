# Every rung of the model ladder against the FE runs, and the studies around it. Takes minutes, so a report does not wait
# for it: it shows the committed result and says where that belongs to another study. `make ladder` makes it anew.
rule ladder_tables:
    input:
        study=STUDY,
        data=DATA_FILES,
        decks=rules.decks.output.inp,
        package=f"{REFERENCES}/datapackage.yaml",
        references=REFERENCE_FILES,
    output:
        folder=directory(f"{RESULTS}/ladder"),
    log:
        "logs/ladder.log",
    benchmark:
        "logs/benchmarks/ladder.tsv"
    conda:
        ENVIRONMENT
    params:
        decks=lambda wildcards, input: Path(input.decks[0]).parents[1],
        references=lambda wildcards, input: Path(input.package).parent,
    message:
        "Running the model ladder"
    shell:
        "tread-validate ladder {input.study} --decks {params.decks} --references {params.references} "
        "-o {output.folder} > {log} 2>&1"


rule ladder:
    input:
        rules.ladder_tables.output.folder,
    log:
        "logs/ladder-filing.log",
    conda:
        ENVIRONMENT
    params:
        target=f"{REFERENCES}/ladder",
    message:
        "Filing the model ladder"
    shell:
        "rm -rf {params.target} && cp -r {input} {params.target} > {log} 2>&1"
