"""The files that a rule makes, and how Snakemake's report shows them."""


def printed(*names):
    """The files of tables by name."""
    return expand("<results>/tables/{name}.{suffix}", name=names, suffix=("csv", "md", "tex"))


def tabulated(*names):
    """The same, their CSV shown in Snakemake's report."""
    read, *others = (
        expand("<results>/tables/{name}.{suffix}", name=names, suffix=s) for s in ("csv", "md", "tex")
    )
    return [*report(read, caption="../report/table.rst", category="Tables"), *others[0], *others[1]]


def pictured(name, caption, category="{case}"):
    """The files of a figure by name, shown in Snakemake's report with a caption of workflow/report."""
    shown = report(f"<results>/figures/{name}.png", caption=f"../report/{caption}.rst", category=category)
    return [shown, f"<results>/figures/{name}.pdf"]


def cause_card(folder):
    """The files of a cause card, its figure shown in Snakemake's report."""
    shown = report(f"{folder}/cause.png", caption="../report/cause.rst", category="{case}")
    return [f"{folder}/cause.json", f"{folder}/cause.md", shown, f"{folder}/traces.json"]


def verified(*names):
    """The files of a case's calibrated beat by name."""
    return [f"<results>/{{case}}/{{setting}}/verification/{name}" for name in names]
