rule draw_volunteer:
    input:
        template="<results>/templates/registration_error.vtu",
        kernels="<results>/kernels.json",
    output:
        mesh="<results>/registration_error/hearts/{number}.vtu",
        motion="<results>/registration_error/hearts/{number}.npz",
        beat="<results>/registration_error/hearts/{number}.json",
        curves="<results>/registration_error/hearts/{number}.csv",
    log:
        "<logs>/registration_error/draw_volunteer_{number}.log",
    benchmark:
        "<benchmarks>/registration_error/draw_volunteer_{number}.tsv"
    resources:
        **needs("draw_volunteer"),
    params:
        error=ERROR,
        heart=STUDY.cohort.heart,
        pressures=STUDY.end_diastolic_pressure,
        stated=stated(ERROR.numerics, STUDY.end_diastolic_pressure, STUDY.cohort.heart, ERROR.seed),
        code=code("draw_volunteer.py"),
    script:
        "../scripts/draw_volunteer.py"


rule try_acquisition:
    input:
        mesh="<results>/registration_error/hearts/{number}.vtu",
        motion="<results>/registration_error/hearts/{number}.npz",
        beat="<results>/registration_error/hearts/{number}.json",
        curves="<results>/registration_error/hearts/{number}.csv",
    output:
        "<results>/registration_error/{acquisition}/{number}.json",
    log:
        "<logs>/registration_error/{acquisition}/try_{number}.log",
    benchmark:
        "<benchmarks>/registration_error/{acquisition}/try_{number}.tsv"
    resources:
        **needs("try"),
    params:
        scanner=scanner_of,
        registration=STUDY.registration.free_form(),
        catheter=STUDY.cohort.catheter.catheter(),
        operator=STUDY.observation,
        stated=stated(scanner_of, STUDY.registration, STUDY.cohort.catheter, STUDY.observation),
        code=code("try_acquisition.py"),
    script:
        "../scripts/try_acquisition.py"


rule learn_noise:
    input:
        expand("<results>/registration_error/baseline/{number}.json", number=TRIED["baseline"]),
    output:
        model=NOISE_MODEL,
        sensors="<results>/registration_error/sensors.json",
    log:
        "<logs>/registration_error/learn_noise.log",
    benchmark:
        "<benchmarks>/registration_error/learn_noise.tsv"
    resources:
        **needs("learn_noise"),
    params:
        protocol=STUDY.protocol(),
        code=code("learn_noise.py"),
    script:
        "../scripts/learn_noise.py"


rule tabulate_registration:
    input:
        [f"<results>/registration_error/{acquisition}/{number}.json" for acquisition, number in TRIALS],
    output:
        costs=expand("<results>/tables/registration.{suffix}", suffix=("csv", "md", "tex")),
        segments=expand("<results>/tables/registration_segments.{suffix}", suffix=("csv", "md", "tex")),
        figure=pictured("registration", "registration", "Measurement"),
    log:
        "<logs>/registration_error/tabulate_registration.log",
    benchmark:
        "<benchmarks>/registration_error/tabulate_registration.tsv"
    resources:
        **needs("tabulate_registration"),
    params:
        settings=STUDY.varied_settings(),
        tried=[ERROR.acquisitions().get(acquisition) for acquisition, _ in TRIALS],
        operator=STUDY.observation,
        frames=STUDY.cohort.scanner.frames,
        code=code("tabulate_registration.py"),
    script:
        "../scripts/tabulate_registration.py"


rule tabulate_noise:
    input:
        model=NOISE_MODEL,
        sensors="<results>/registration_error/sensors.json",
        learnt=expand("<results>/registration_error/baseline/{number}.json", number=TRIED["baseline"]),
        fresh=expand("<results>/registration_error/baseline/{number}.json", number=FRESH),
    output:
        left_out=expand("<results>/tables/noise_model.{suffix}", suffix=("csv", "md", "tex")),
        fresh=expand("<results>/tables/noise_model_fresh.{suffix}", suffix=("csv", "md", "tex")),
        sensors=expand("<results>/tables/sensors.{suffix}", suffix=("csv", "md", "tex")),
        figure=pictured("noise_model", "noise_model", "Measurement"),
    log:
        "<logs>/registration_error/tabulate_noise.log",
    benchmark:
        "<benchmarks>/registration_error/tabulate_noise.tsv"
    resources:
        **needs("tabulate_noise"),
    params:
        code=code("tabulate_noise.py"),
    script:
        "../scripts/tabulate_noise.py"
