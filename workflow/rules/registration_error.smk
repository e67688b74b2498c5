rule draw_volunteer:
    input:
        template=template_file("registration_error"),
        kernels="<results>/kernels.json",
    output:
        mesh="<results>/registration_error/hearts/{number}.vtu",
        motion="<results>/registration_error/hearts/{number}.npz",
        beat="<results>/registration_error/hearts/{number}.json",
        curves="<results>/registration_error/hearts/{number}.csv",
    params:
        error=REGISTRATION_ERROR,
        heart=STUDY.cohort.heart,
        pressures=STUDY.end_diastolic_pressure,
        stated=configuration_text(
            REGISTRATION_ERROR.numerics,
            STUDY.end_diastolic_pressure,
            STUDY.cohort.heart,
            REGISTRATION_ERROR.seed,
        ),
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
    params:
        scanner=scanner_of,
        registration=STUDY.registration.free_form(),
        catheter=STUDY.cohort.catheter.catheter(),
        operator=STUDY.observation,
        stated=configuration_text(scanner_of, STUDY.registration, STUDY.cohort.catheter, STUDY.observation),
    script:
        "../scripts/try_acquisition.py"


rule learn_noise:
    input:
        registered_sequences("baseline", SEQUENCES["baseline"]),
    output:
        model=LEARNT_NOISE,
        sensors="<results>/registration_error/sensors.json",
    params:
        protocol=STUDY.protocol(),
    script:
        "../scripts/learn_noise.py"


rule tabulate_registration:
    input:
        [registered_sequences(acquisition, numbers) for acquisition, numbers in SEQUENCES.items()],
    output:
        costs=table_files("registration"),
        segments=table_files("registration_segments"),
        figure=figure_files("registration", "registration", "Measurement"),
    params:
        settings=STUDY.varied_settings(),
        tried=[
            REGISTRATION_ERROR.acquisitions().get(acquisition)
            for acquisition, numbers in SEQUENCES.items()
            for _ in numbers
        ],
        operator=STUDY.observation,
        frames=STUDY.cohort.scanner.frames,
    script:
        "../scripts/tabulate_registration.py"


rule tabulate_noise:
    input:
        model=LEARNT_NOISE,
        sensors="<results>/registration_error/sensors.json",
        learnt=registered_sequences("baseline", SEQUENCES["baseline"]),
        fresh=registered_sequences("baseline", VALIDATION_SEQUENCES),
    output:
        left_out=table_files("noise_model"),
        fresh=table_files("noise_model_fresh"),
        sensors=table_files("sensors"),
        figure=figure_files("noise_model", "noise_model", "Measurement"),
    script:
        "../scripts/tabulate_noise.py"
