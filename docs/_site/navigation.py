"""The lists of index.md are the navigation: each of its sections becomes a caption, each page it links to an entry."""

import re

SECTION = re.compile(r"^## (.+)$", re.MULTILINE)
PAGE = re.compile(r"\]\(([\w/]+)\.md\)")


def setup(app):
    app.connect("source-read", add_navigation)
    return {"parallel_read_safe": True}


def add_navigation(_, name, source):
    if name == "index":
        _, *parts = SECTION.split(source[0])
        source[0] += "".join(map(section, parts[::2], parts[1::2]))
        source[0] += toctree(["api/modules"], ":hidden:", ":caption: Library")
    if name == "validation":
        source[0] += toctree(["studies/*/*"], ":glob:", ":hidden:", ":maxdepth: 1")
    if name == "decisions/README":
        source[0] += toctree(PAGE.findall(source[0]), ":hidden:", ":maxdepth: 1")


def section(caption, text):
    return toctree(PAGE.findall(text), ":hidden:", f":caption: {caption}")


def toctree(pages, *options):
    return "\n".join(["", "```{toctree}", *options, "", *pages, "```", ""])
