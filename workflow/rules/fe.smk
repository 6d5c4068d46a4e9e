# Decks -> FE reference runs. A report never waits for these: it uses the committed references whose deck digest
# still matches and says which are stale or missing. `make reference` runs just those.
checkpoint stale_references:
    input:
        study=STUDY,
        decks=rules.decks.output.inp,
    output:
        f"{RESULTS}/fe/stale.txt",
    log:
        "logs/stale_references.log",
    conda:
        ENVIRONMENT
    params:
        decks=lambda wildcards, input: Path(input.decks[0]).parents[1],
        references=REFERENCES,
    message:
        "Looking for stale references"
    shell:
        "tread-validate stale {input.study} --decks {params.decks} --references {params.references} "
        "-o {output} > {log} 2>&1"


rule fe:
    input:
        inp=f"{DECKS}/{{case}}/{{case}}.inp",
        user=f"{DECKS}/{{case}}/vfric.f",
    output:
        history=f"{RESULTS}/fe/embedded/{{case}}.csv",
        record=f"{RESULTS}/fe/embedded/{{case}}.yaml",
    log:
        "logs/fe/{case}.log",
    benchmark:
        "logs/benchmarks/fe/{case}.tsv"
    conda:
        ENVIRONMENT
    threads: 1
    message:
        "Running the FE engine on {wildcards.case}"
    shell:
        "tread-validate fe {input.inp} --user {input.user} -o {output.history} > {log} 2>&1"


rule reference:
    input:
        histories=stale_histories,
        decks=rules.decks.output.inp,
    log:
        "logs/reference.log",
    conda:
        ENVIRONMENT
    params:
        engine=ENGINE,
        study=study.model.name,
        decks=lambda wildcards, input: Path(input.decks[0]).parents[1],
        references=REFERENCES,
    message:
        "Filing the reference runs"
    shell:
        "tread-validate file-references {input.histories} --engine {params.engine} --decks {params.decks} "
        "--study {params.study} --references {params.references} > {log} 2>&1"
