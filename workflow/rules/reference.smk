# The reference data package: every table against its schema and checksum.
rule references:
    input:
        package=f"{REFERENCES}/datapackage.yaml",
        published=f"{REFERENCES}/published/published.csv",
    output:
        f"{RESULTS}/references.txt",
    log:
        "logs/references.log",
    benchmark:
        "logs/benchmarks/references.tsv"
    conda:
        ENVIRONMENT
    params:
        folder=lambda wildcards, input: Path(input.package).parent,
    message:
        "Checking the reference data"
    shell:
        "tread-validate references {params.folder} -o {output} > {log} 2>&1"
