"""All that the study makes."""

# what is learnt of methods from hearts whose truth is known; a study of measured hearts alone does without
OF_METHODS = ["alternatives", "coverage_sphere", "registration", "noise_model", "sobol"] if VIRTUAL else []
PICTURES = [
    *OF_METHODS,
    *(["septal_flash"] if GROUPS.patients else []),
    *(f"{case}_activation" for case in CASES),
    *(f"sensitivity{about}_{setting}" for about in ("", "_curves") for setting in SETTINGS),
    *(f"{case}_contours" for case in VIRTUAL + IMAGED),
    *(f"{case}_{SETTINGS[-1]}_overlay" for case in DYSSYNCHRONY),
    *(f"{case}_cine_{about}" for case in CINE for about in ("outlines", "volume")),
    *(f"residual_{case}_{setting}" for case in CASES for setting in SETTINGS),
]
CASE_PICTURES = [
    f"{case}_{setting}{about}.{kind}"
    for case in CASES
    for setting in SETTINGS
    for about in ("", "_sensitivity", "_shape", "_card")
    for kind in ("png", "pdf")
]
TABLES = [
    "table1",
    "cards",
    *(["specificity", "selection"] if VIRTUAL else []),
    *(f"sensitivity_{setting}" for setting in SETTINGS),
]


def whole_study():
    """All that the study makes, but for what it took."""
    return [
        *expand("<results>/tables/{name}.md", name=TABLES),
        *expand("<results>/tables/{name}.csv", name=("posteriors", "curves")),
        *expand("<results>/{case}/{setting}/inference.nc", case=CASES, setting=SETTINGS),
        *expand("<results>/figures/{picture}", picture=CASE_PICTURES),
        *expand("<results>/figures/{about}.png", about=PICTURES),
        # asked for by name, or Snakemake would not miss a beat that was deleted
        *(beat for case in CASES for setting in SETTINGS for beat in beats_of(case, setting)),
        *surroundings(SETTINGS),
        *expand(
            "<results>/{case}/discovery/{setting}/search/cause.json", case=CASES, setting=DISCOVERY.settings
        ),
        *(f"<results>/{case}/discovery/{setting}/cause.json" for case, setting in PROVED),
        *(["<results>/tables/discovery.md"] if EVALUATED else []),
        *(f"<results>/figures/trials_{case}_{setting}.png" for case, setting in PROVED if DISCOVERY.trials),
    ]
