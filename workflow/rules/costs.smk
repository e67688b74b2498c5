# after everything else, whose benchmarks it reads: a job's benchmark is a product of its rule, but all of them by name
# would be a second list of all jobs
rule tabulate_costs:
    input:
        whole_study(),
    output:
        tabulated("costs"),
        pictured("costs", "costs", "Cohort"),
    log:
        "<logs>/tabulate_costs.log",
    benchmark:
        "<benchmarks>/tabulate_costs.tsv"
    resources:
        **needs("tabulate_costs"),
    params:
        results=results_folder,
        code=code("tabulate_costs.py"),
    script:
        "../scripts/tabulate_costs.py"
