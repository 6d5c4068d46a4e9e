# The workflow about itself: which rule needs which, for the report's drawing; and the run times that Snakemake measured, on a
# page beside the report, so that the report itself is the same to the byte from run to run.
rule rule_graph:
    output:
        f"{RESULTS}/workflow.txt",
    log:
        f"{LOGS}/rule_graph.log",
    conda:
        ENVIRONMENT
    params:
        lines=rule_lines,
    message:
        "Noting which rule needs which"
    shell:
        "printf '%s\\n' {params.lines:q} > {output} 2> {log}"
