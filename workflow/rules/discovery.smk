rule plot_residual:
    input:
        **calibrated_beats(),
        mesh="<results>/{case}/geometry/mesh.vtu",
        measured="<results>/{case}/curves/measured.csv",
        registered="<results>/{case}/registration/motion.npz",
        noise=noise_of,
        known=sequences_of_known_truth,
    output:
        table="<results>/{case}/discovery/{setting}/residual.csv",
        figure=expand("<results>/figures/residual_{{case}}_{{setting}}.{suffix}", suffix=("png", "pdf")),
    log:
        "<logs>/{case}/{setting}/plot_residual.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/plot_residual.tsv"
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        setting=setting_of,
        mechanisms=mechanisms_of,
        stated=stated(setting_of),
        code=code("plot_residual.py"),
    script:
        "../scripts/plot_residual.py"
