# What the mesh of the reference runs is worth: one typical case of every kind of path and block (the rule of choice is
# that of `typical_cases`), on the study's mesh, one of twice and one of half its element size.


rule mesh_deck:
    input:
        study=STUDY,
        data=DATA_FILES,
    output:
        inp=f"{RESULTS}/mesh/{{mesh}}/{{case}}/{{case}}.inp",
        user=f"{RESULTS}/mesh/{{mesh}}/{{case}}/vfric.f",
    log:
        f"{LOGS}/mesh/{{mesh}}/{{case}}-deck.log",
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards, output: Path(output.inp).parents[1],
        mesh=mesh_options,
        code=CODE["deck"],
    message:
        "Writing the {wildcards.mesh} deck of {wildcards.case}"
    shell:
        "tread-validate deck {input.study} --case {wildcards.case} {params.mesh} -o {params.folder} > {log} 2>&1"


rule mesh_run:
    input:
        inp=rules.mesh_deck.output.inp,
        user=rules.mesh_deck.output.user,
    output:
        history=f"{RESULTS}/mesh/{{mesh}}/{{case}}.csv",
        record=f"{RESULTS}/mesh/{{mesh}}/{{case}}.yaml",
    log:
        f"{LOGS}/mesh/{{mesh}}/{{case}}.log",
    benchmark:
        f"{LOGS}/benchmarks/mesh-{{mesh}}/{{case}}.tsv"
    conda:
        ENVIRONMENT
    params:
        run=lambda wildcards: RUNS[ENGINE],
        code=ENGINE_CODE[ENGINE],
    message:
        "Running {wildcards.case} on the {wildcards.mesh} mesh"
    shell:
        "tread-validate {params.run} {input.inp} --user {input.user} -o {output.history} > {log} 2>&1"


rule mesh_error:
    input:
        study=STUDY,
        runs=expand(f"{RESULTS}/mesh/{{mesh}}/{{{{case}}}}.csv", mesh=MESHES),
    output:
        f"{RESULTS}/mesh/{{case}}.yaml",
    log:
        f"{LOGS}/mesh/{{case}}.log",
    conda:
        ENVIRONMENT
    params:
        sizes=lambda wildcards: [
            f"--size {mesh_in_use(wildcards).element_size_mm * factor:g}"
            for factor in MESHES.values()
        ],
        code=CODE["compare"],
    message:
        "Extrapolating {wildcards.case} to element size 0"
    shell:
        "tread-validate mesh-error {input.study} {input.runs} {params.sizes} -o {output} > {log} 2>&1"


rule mesh_study:
    input:
        expand(f"{RESULTS}/mesh/{{case}}.yaml", case=MESH_CASES),
    log:
        f"{LOGS}/mesh_study.log",
    conda:
        ENVIRONMENT
    params:
        references=lambda wildcards: REFERENCES,
        studies=lambda wildcards, input: [f"--mesh {file}" for file in input],
    message:
        "Filing the mesh study"
    shell:
        "tread-validate file-references {params.studies} --references {params.references} > {log} 2>&1"
