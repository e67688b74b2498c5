rule average_pressure:
    input:
        recording=pressure_recording,
        motion="<results>/{case}/registration/motion.npz",
    output:
        "<results>/{case}/curves/pressure.csv",
    wildcard_constraints:
        case=match_any(RECORDED),
    resources:
        mem_mb=500,
        runtime=5,
    params:
        source=source_of,
        stated=configuration_text(source_of),
    script:
        "../scripts/average_pressure.py"


rule extract_curves:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        motion="<results>/{case}/registration/motion.npz",
        noise=noise_model,
        pressure=pressure_curve,
    output:
        curves="<results>/{case}/curves/measured.csv",
        observations="<results>/{case}/curves/observations.json",
    params:
        operator=STUDY.observation,
        protocol=STUDY.protocol(),
        also=curves_besides,
        stated=configuration_text(STUDY.observation, curves_besides),
    script:
        "../scripts/extract_curves.py"


rule read_blood_volume:
    input:
        files=wall_files,
        images="<results>/{case}/images/cine.nrrd",
        measured="<results>/{case}/curves/measured.csv",
    output:
        "<results>/{case}/curves/blood_volume.csv",
    wildcard_constraints:
        case=match_any(FITTED_WITH_IMAGES),
    resources:
        mem_mb=1500,
        runtime=2,
    params:
        source=source_without_pressure,
        stated=configuration_text(source_without_pressure),
    script:
        "../scripts/read_blood_volume.py"
