rule register_measured:
    input:
        files=measured_files,
        mesh="<results>/{case}/geometry/mesh.vtu",
    output:
        "<results>/{case}/registration/motion.npz",
    log:
        "<logs>/{case}/register.log",
    benchmark:
        "<benchmarks>/{case}/register.tsv"
    wildcard_constraints:
        case=one_of(MEASURED),
    resources:
        mem_mb=1500,
        runtime=10,
    params:
        folder=str(HEART),
        code=code("register_measured.py"),
    script:
        "../scripts/register_measured.py"


rule register_volunteer:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        acquisition="<results>/{case}/cohort/acquisition.vtu",
        motion="<results>/{case}/cohort/acquisition.npz",
    output:
        "<results>/{case}/registration/motion.npz",
    log:
        "<logs>/{case}/register.log",
    benchmark:
        "<benchmarks>/{case}/register.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL),
    resources:
        mem_mb=1500,
        runtime=10,
    params:
        code=code("register_volunteer.py"),
    script:
        "../scripts/register_volunteer.py"
