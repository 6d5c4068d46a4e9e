# The same decks in another engine, where the study's `engine` asks for it: `make reference` files the histories.
rule abaqus:
    input:
        inp=f"{DECKS}/{{case}}/{{case}}.inp",
        user=f"{DECKS}/{{case}}/vfric.f",
        settings="config/engines.yaml",
    output:
        history=f"{RESULTS}/fe/abaqus/{{case}}.csv",
        record=f"{RESULTS}/fe/abaqus/{{case}}.yaml",
    log:
        "logs/abaqus/{case}.log",
    benchmark:
        "logs/benchmarks/abaqus/{case}.tsv"
    conda:
        ENVIRONMENT
    threads: 1
    message:
        "Running ABAQUS on {wildcards.case}"
    shell:
        "tread-validate abaqus {input.inp} --user {input.user} --settings {input.settings} "
        "-o {output.history} > {log} 2>&1"


rule calculix:
    input:
        inp=f"{DECKS}/{{case}}/{{case}}.inp",
        user=f"{DECKS}/{{case}}/vfric.f",
    output:
        history=f"{RESULTS}/fe/calculix/{{case}}.csv",
        record=f"{RESULTS}/fe/calculix/{{case}}.yaml",
    log:
        "logs/calculix/{case}.log",
    benchmark:
        "logs/benchmarks/calculix/{case}.tsv"
    conda:
        ENVIRONMENT
    threads: 1
    message:
        "Running CalculiX on {wildcards.case}"
    shell:
        "tread-validate calculix {input.inp} --user {input.user} -o {output.history} > {log} 2>&1"
