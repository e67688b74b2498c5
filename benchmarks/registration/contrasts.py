"""Value of the muscle's texture and of the valve plane's features: scanners that show less of them."""

from dataclasses import replace

from heartfit.synthetic.scanner import Contrast, Scanner

BARE = {"leaflets": Contrast().blood, "fat": Contrast().lung}
"""Leaflets as bright as blood, fat as lung: the ends of the ventricles show as edges of muscle alone."""

USUAL = "texture 0.2, leaflets and fat"
CONTRASTS = {
    USUAL: Contrast(),
    "texture 0.1, leaflets and fat": Contrast(muscle_texture=0.1),
    "no texture, leaflets and fat": Contrast(muscle_texture=0.0),
    "texture 0.2, no valve features": Contrast(**BARE),
    "no texture, no valve features": Contrast(muscle_texture=0.0, **BARE),
}


def scanner(name: str) -> Scanner:
    """The scanner that shows this contrast."""
    return replace(Scanner(), contrast=CONTRASTS[name])
