# Decks -> reference runs by the study's engine. A report never waits for these: it uses the filed references of the same
# problems and says which are stale or missing. `make reference` runs just those: the built-in engine's side by side in
# one job, as every start of a process costs what a third of a short pass does; other engines', and all on a cluster
# (`one_job_a_pass`), in a job each.
checkpoint stale_references:
    input:
        study=STUDY,
        decks=rules.decks.output.inp,
        references=REFERENCE_FILES,
    output:
        f"{RESULTS}/fe/stale.txt",
    log:
        f"{LOGS}/stale_references.log",
    conda:
        ENVIRONMENT
    params:
        decks=lambda wildcards: DECKS,
        references=lambda wildcards: REFERENCES,
        settings=lambda wildcards: SETTINGS,
        code=ENGINE_CODE,
    message:
        "Looking for stale references"
    shell:
        "tread-validate stale {input.study} --decks {params.decks} --references {params.references} "
        "--runnable --settings {params.settings} -o {output} > {log} 2>&1"


rule fe:
    input:
        inp=f"{DECKS}/{{case}}/{{case}}.inp",
        user=f"{DECKS}/{{case}}/vfric.f",
    output:
        history=f"{RESULTS}/fe/{ENGINE}/{{case}}.csv",
        record=f"{RESULTS}/fe/{ENGINE}/{{case}}.yaml",
    log:
        f"{LOGS}/fe/{{case}}.log",
    benchmark:
        f"{LOGS}/benchmarks/fe/{{case}}.tsv"
    conda:
        ENVIRONMENT
    threads: 1
    params:
        run=lambda wildcards: RUNS[ENGINE],
        code=ENGINE_CODE[ENGINE],
    message:
        f"Running engine {ENGINE} on {{wildcards.case}}"
    shell:
        "tread-validate {params.run} {input.inp} --user {input.user} -o {output.history} > {log} 2>&1"


if ENGINE == "embedded" and not config["one_job_a_pass"]:

    rule reference:
        input:
            study=STUDY,
            data=DATA_FILES,
            decks=rules.decks.output.inp,
        log:
            f"{LOGS}/reference.log",
        conda:
            ENVIRONMENT
        threads: workflow.cores
        params:
            decks=lambda wildcards: DECKS,
            references=lambda wildcards: REFERENCES,
            runs=f"{RESULTS}/fe/reference",
            logs=lambda wildcards: LOGS,
            replace="--replace" if config["replace"] else "",
        message:
            "Running and filing the outstanding references, {threads} at a time"
        # to the screen as well, for it takes minutes; an interrupt ends the runs, and the log takes their last words
        shell:
            "tread-validate run-references {input.study} --decks {params.decks} --references {params.references} "
            "--output {params.runs} --logs {params.logs} --jobs {threads} {params.replace} 2>&1 | tee -i {log}"

else:

    rule reference:
        input:
            histories=stale_histories,
            decks=rules.decks.output.inp,
        log:
            f"{LOGS}/reference.log",
        conda:
            ENVIRONMENT
        params:
            engine=ENGINE,
            study=NAME,
            decks=lambda wildcards: DECKS,
            references=lambda wildcards: REFERENCES,
            replace="--replace" if config["replace"] else "",
        message:
            "Filing the reference runs"
        shell:
            "tread-validate file-references {input.histories} --engine {params.engine} --decks {params.decks} "
            "--study {params.study} --references {params.references} {params.replace} > {log} 2>&1"
