"""The reports of studies/ are pages of the site: copied to docs/studies before a build, and linked there."""

import shutil
from pathlib import Path

DOCS = Path(__file__).parents[1]
SOURCE, COPY = DOCS.parent / "studies", DOCS / "studies"


def setup(app):
    app.connect("config-inited", copy_reports)
    app.connect("source-read", link_to_copies)
    return {"parallel_read_safe": True}


def copy_reports(*_):
    """Copy the reports, whose links to pages of docs lead one folder less up."""
    shutil.rmtree(COPY, ignore_errors=True)
    for report in SOURCE.glob("*/*.md"):
        page = COPY / report.relative_to(SOURCE)
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(
            report.read_text(encoding="utf-8").replace("](../../docs/", "](../../"), encoding="utf-8"
        )


def link_to_copies(_, name, source):
    """Let a page of docs link to the copies."""
    up = "../" * name.count("/")
    source[0] = source[0].replace(f"]({up}../studies/", f"]({up}studies/")
