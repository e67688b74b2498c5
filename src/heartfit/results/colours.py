"""Colour of each setting of a study: the same in all its figures and in its report.

Among curves and estimates no colour of a setting has another meaning: measured is black, the prior grey, and in a cause
card blue is without and vermilion with a mechanism.

References
----------
Okabe M, Ito K 2008, https://jfly.uni-koeln.de/color (bluish green, orange); Tol P 2021, technical note
SRON/EPS/TN/09-002 (the others): distinct for colour-blind readers.
"""

from collections.abc import Iterable

SETTING_COLOURS = ("#009E73", "#AA4499", "#E69F00", "#332288", "#999933", "#882255")


def setting_colours(settings: Iterable[str]) -> dict[str, str]:
    """Return the colour of each setting by its place in the list of the study; that of the first for a seventh."""
    return {setting: SETTING_COLOURS[place % len(SETTING_COLOURS)] for place, setting in enumerate(settings)}
