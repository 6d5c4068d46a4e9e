# One rig and one belt case on three meshes: what the mesh of the reference runs is worth.
rule mesh_deck:
    input:
        study=STUDY,
        data=DATA_FILES,
    output:
        inp=f"{RESULTS}/mesh/{{size}}/{{case}}/{{case}}.inp",
        user=f"{RESULTS}/mesh/{{size}}/{{case}}/vfric.f",
    log:
        "logs/mesh/{size}/{case}-deck.log",
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards, output: Path(output.inp).parents[1],
        element=lambda wildcards: wildcards.size.replace("p", "."),
        layers=lambda wildcards: MESH_LAYERS[wildcards.size],
    message:
        "Writing the {wildcards.size} mm deck of {wildcards.case}"
    shell:
        "tread-validate deck {input.study} --case {wildcards.case} --element-size {params.element} "
        "--layers {params.layers} -o {params.folder} > {log} 2>&1"


rule mesh_run:
    input:
        inp=rules.mesh_deck.output.inp,
        user=rules.mesh_deck.output.user,
    output:
        history=f"{RESULTS}/mesh/{{size}}/{{case}}.csv",
    log:
        "logs/mesh/{size}/{case}.log",
    benchmark:
        "logs/benchmarks/mesh-{size}/{case}.tsv"
    conda:
        ENVIRONMENT
    message:
        "Running {wildcards.case} on the {wildcards.size} mm mesh"
    shell:
        "tread-validate fe {input.inp} --user {input.user} -o {output.history} > {log} 2>&1"


rule mesh_error:
    input:
        study=STUDY,
        runs=lambda wildcards: expand(
            f"{RESULTS}/mesh/{{size}}/{{case}}.csv",
            size=MESH_LAYERS,
            case=MESH_CASES[wildcards.kind],
        ),
    output:
        f"{RESULTS}/mesh/{{kind}}.yaml",
    log:
        "logs/mesh/{kind}.log",
    conda:
        ENVIRONMENT
    params:
        sizes=" ".join(f"--size {size.replace('p', '.')}" for size in MESH_LAYERS),
    message:
        "Extrapolating the {wildcards.kind} case to element size 0"
    shell:
        "tread-validate mesh-error {input.study} {input.runs} {params.sizes} -o {output} > {log} 2>&1"


# The result is copied over the committed one, which `make reference` reads and never makes by itself.
rule mesh_study:
    input:
        expand(f"{RESULTS}/mesh/{{kind}}.yaml", kind=MESH_CASES),
    log:
        "logs/mesh_study.log",
    conda:
        ENVIRONMENT
    params:
        target=MESH_ERRORS,
    message:
        "Filing the mesh study"
    shell:
        "mkdir -p {params.target} && cp {input} {params.target} > {log} 2>&1"
