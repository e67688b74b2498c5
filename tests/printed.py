"""Numbers and cells of texts for readers, so that a test checks their facts and not their wording."""

import re

NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def numbers_in(text: str) -> list[float]:
    """Numbers of a text in their order, without digits inside a word or after a dot."""
    return [float(number.replace("−", "-")) for number in NUMBER.findall(text)]


def rows_of(page: str) -> dict[str, list[str]]:
    """Cells of each row of the Markdown tables of a page by its first cell, headings included."""
    rows = [line.strip("| ").split(" | ") for line in page.splitlines() if line.startswith("| ")]
    return {first: [cell.strip() for cell in cells] for first, *cells in rows}
