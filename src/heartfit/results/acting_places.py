"""Sentences on the regions on which something unknown acts."""

from collections.abc import Mapping, Sequence

from heartfit.discovery.sphere_model.cause import ActingPlace, ClearSpan, RankedLaw
from heartfit.places import Region
from heartfit.results.text import AMPLITUDE_UNITS, two_digits

REGIONS: Mapping[Region, str] = {
    "filling": "the left atrium or the mitral valve",
    "ejection": "the aorta or the aortic valve",
    "leak": "a leak out of the left ventricle",
    "backflow": "a backflow from the aorta into the left ventricle",
    "wall": "the wall of the left ventricle",
    "muscle": "the muscle",
    "images": "the images",
    "catheter": "the catheter",
}
FLOWS: tuple[Region, ...] = ("leak", "backflow")
"""Regions that are flows: an effect is one of them rather than acting on it."""
EQUIVALENT: Mapping[Region, str] = {
    "filling": "a pressure of the atrium and a loss in the valve",
    "ejection": "a pressure of the aorta and a loss in the valve",
    "leak": "where the blood goes, to the atrium or to the right ventricle",
    "backflow": "how the blood passes the valve",
    "wall": "a pressure around the wall and the wall's own elasticity",
    "muscle": "the parts of the muscle",
    "images": "scanner, segmentation and registration",
    "catheter": "line, transducer and amplifier",
}
"""Causes within a region that volume and pressure of the left ventricle do not tell apart."""
SEPARATED_BY: Mapping[Region, str] = {
    "filling": "a left atrial or wedge pressure",
    "ejection": "an aortic pressure",
    "leak": "the flow through the mitral valve by Doppler or phase contrast",
    "backflow": "the flow in the aortic root by phase contrast",
    "wall": "the same heart with raised legs",
    "muscle": "the same heart at another rate",
    "images": "a second reading of the images",
    "catheter": "a second catheter, or the aortic pressure",
}
"""The measurement that shows whether something acts on a region."""


FALSE_PLACES = (
    "A place is told only where the simulator is trusted (`--trust-simulator`). Of healthy hearts of another "
    "generator than the simulator's, 2 of 6 were given one although nothing acts there; of sound hearts of the "
    "benchmark's own generator, 0 of 33."
)
"""Rate of hearts that need no place and are given one; studies/discovery/places.md."""


SOMETHING = "If the simulator can be trusted, something that the library lacks acts"


def acting_sentence(acting: Sequence[ActingPlace]) -> str:
    """Return "If the simulator can be trusted, something acts on REGION: SIZE, TIMES; it follows LAW.", or several."""
    if len(acting) > 1:
        regions = " or ".join(acts(one.region) for one in acting)
        return f"{SOMETHING} {regions}; these data do not tell which."
    (one,) = acting
    size = f": {span_text(one.spans[0])}" if one.spans else ""
    law = f"; it follows {law_text(one.laws[0])}" if one.laws else ""
    return f"{SOMETHING} {acts(one.region)}{size}{law}."


def acts(region: Region) -> str:
    """Return "on the muscle", or "as a leak out of the left ventricle"."""
    return f"{'as' if region in FLOWS else 'on'} {REGIONS[region]}"


def span_text(span: ClearSpan) -> str:
    """Return "91 ± 11 mL/s, 230 to 380 ms after the trigger"."""
    unit, factor = AMPLITUDE_UNITS[span.unit]
    size = f"{two_digits(factor * span.size)} ± {two_digits(factor * span.sd)} {unit}".strip()
    return f"{size}, {1e3 * span.start:.0f} to {1e3 * span.end:.0f} ms after the trigger"


def law_text(law: RankedLaw) -> str:
    """Return "an orifice law of 0.27 cm²", or "a pulse law of ..." with its shape."""
    article = "an" if law.name[0] in "aeiou" else "a"
    return f"{article} {law.name} law of {_law_size(law)}"


def acting_section(acting: Sequence[ActingPlace], threshold: float) -> str:
    """Return the section of the card: how often a place is false, and each region with its evidence, sizes and laws.

    threshold: ln Bayes factor of a detection.
    """
    paragraphs = [FALSE_PLACES, *(_paragraph(one, threshold) for one in acting)]
    return "## Where it acts\n\n" + "\n\n".join(paragraphs)


def _paragraph(one: ActingPlace, threshold: float) -> str:
    region = one.region
    spans = "; ".join(map(span_text, one.spans[:3])) or "no time at which it is clear"
    name = REGIONS[region]
    return (
        f"**{name[0].upper()}{name[1:]}**: ln Bayes factor {one.ln_bayes_factor:.1f} (threshold {threshold:g}), by "
        f"{one.slot}. Clear: {spans}. Not told apart: {EQUIVALENT[region]}.\n\n{_laws_table(one.laws)}"
    )


def _laws_table(laws: Sequence[RankedLaw]) -> str:
    rows = [f"| {law.name} | ${law.formula}$ | {_law_size(law)} | {law.ln_likelihood:.1f} |" for law in laws]
    return "| law | formula | size | ln likelihood minus that of the best |\n|---|---|---|---|\n" + "\n".join(
        rows
    )


def _law_size(law: RankedLaw) -> str:
    unit, factor = AMPLITUDE_UNITS[law.unit]
    return f"{two_digits(factor * law.size)} {unit}".strip()


def separating_measurement(acting: Sequence[ActingPlace]) -> str:
    """Return the measurement that shows on which of the regions something acts, or what the region leaves open."""
    return f"{SEPARATED_BY[acting[0].region]}: it shows whether something acts {acts(acting[0].region)}."
