# Study -> force histories of the user's own models, a job a model. Nothing of theirs runs before it is trusted, and a case
# that fails fails alone: its outcome says why, and the tables count it.
try:
    require_trust(study, bool(config["trust_models"]))
    MODELS = {name: code_of(study, name) for name in study.model.models}
except InputError as error:
    raise WorkflowError(str(error)) from None


rule model:
    input:
        study=STUDY,
        data=DATA_FILES,
    output:
        summary=f"{RESULTS}/models/{{model}}/summary.csv",
    log:
        f"{LOGS}/model-{{model}}.log",
    benchmark:
        f"{LOGS}/benchmarks/model-{{model}}.tsv"
    conda:
        ENVIRONMENT
    threads: workflow.cores
    params:
        folder=lambda wildcards, output: str(Path(output.summary).parent),
        code=lambda wildcards: MODELS[wildcards.model],
    message:
        "Running the model {wildcards.model}"
    shell:
        "tread-validate model {input.study} --model {wildcards.model} --jobs {threads} --report-only --trust-models "
        "-o {params.folder} > {log} 2>&1"
