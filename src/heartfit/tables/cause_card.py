"""The cause card in words that a cardiologist reads."""

import re
from collections.abc import Iterable

from heartfit.diagnosis.cause import Cause, Diagnosis, Gain, Refitted
from heartfit.diagnosis.departure import Departure, departures

CURVES = {
    "lv_volume": "left ventricular volume",
    "lv_pressure": "left ventricular pressure",
    "aorta_pressure": "aortic pressure",
    "rv_volume": "right ventricular volume",
}
UNITS = {"m^2": ("cm²", 1e4), "m^3": ("mL", 1e6), "Pa": ("kPa", 1e-3), "s": ("ms", 1e3), "1": ("", 1.0)}


def sentence(diagnosis: Diagnosis) -> str:
    """The diagnosis in one sentence."""
    named = " and ".join(sized(each) for each in diagnosis.mechanisms)
    return {
        "none": f"The simulation explains {_explained(diagnosis)}: nothing is missing that these data could show.",
        "named": f"The simulation lacks {named}.",
        "two": f"The simulation lacks {named}.",
        "group": f"The simulation lacks one of {_names(diagnosis)}: these data do not tell them apart.",
        "unknown": "The simulation misses something that no mechanism of the library explains.",
        "insufficient": "These data cannot tell what the simulation misses.",
    }[diagnosis.verdict]


def _explained(diagnosis: Diagnosis) -> str:
    """ "the recording", or what of it was searched where another curve departs."""
    apart = {each.curve for each in departures(diagnosis) if each.clear} & set(diagnosis.unsearched)
    besides = " and ".join(CURVES[name] for name in sorted(apart))
    return f"the recording but for the {besides}, which was not searched" if apart else "the recording"


def sized(cause: Cause) -> str:
    """ "mitral regurgitation of 0.31 cm² (0.24 to 0.39)"."""
    unit, factor = UNITS.get(cause.unit, (cause.unit, 1.0))
    value, low, high = (f"{factor * each:.3g}" for each in (cause.amplitude, *cause.interval))
    return f"{spoken(cause.name)} of {f'{value} {unit}'.strip()} (95 % interval {low} to {high})"


def spoken(name: str) -> str:
    """ "mitral regurgitation" of MitralRegurgitation."""
    return re.sub(r"(?<!^)(?=[A-Z])", " ", name).lower()


def _names(diagnosis: Diagnosis) -> str:
    return ", ".join(spoken(each.name) for each in diagnosis.mechanisms)


def card(diagnosis: Diagnosis, title: str) -> str:
    """The card in Markdown: what is missed, what it is, what else it could be, what to measure, what is gained."""
    lacking = [f"- {missed(each)}" for each in departures(diagnosis)]
    lacking += [f"- {CURVES[name]}: not searched, {why}." for name, why in diagnosis.unsearched.items()]
    parts = [
        f"# {title}\n\n**{sentence(diagnosis)}**",
        "## What the simulation misses\n\n" + "\n".join(lacking),
        "## How strongly the data speak\n\n" + _ranking(diagnosis),
        "## What else could explain it\n\n" + alternatives(diagnosis),
        "## What to measure next\n\n" + (diagnosis.next_measurement or "Nothing: the data decide."),
        f"## What {gaining(diagnosis)} gains where nothing was fitted\n\n" + gains(diagnosis.gain),
        *([f"## In three dimensions\n\n{in_three_dimensions(diagnosis.refitted)}"] if diagnosis.refitted else []),
        *([tested(diagnosis)] if diagnosis.self_test is not None else []),
        f"{diagnosis.simulations} simulated beats in all.",
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"


def tested(diagnosis: Diagnosis) -> str:
    """What the search finds where nothing is hidden, and the threshold that follows from it."""
    return (
        "In beats of the model itself, in which nothing is hidden, the largest ln Bayes factor is "
        f"{diagnosis.self_test:.1f} (median): an effect is detected from {diagnosis.threshold:g}."
    )


def missed(each: Departure) -> str:
    """ "aortic pressure: simulated 0.8 ± 0.2 kPa too low in ejection, 4.0 standard deviations, 120 ms after ..."."""
    curve, (unit, factor) = CURVES.get(each.curve, each.curve), unit_of(each.curve)
    if not each.clear:
        return f"{curve}: nothing beyond its noise."
    size, doubt = factor * abs(each.size), factor * each.sd
    return (
        f"{curve}: simulated {size:.2g} ± {doubt:.1g} {unit} {wrong(each)}, "
        f"{abs(each.deviations):.1f} standard deviations, {1e3 * each.time:.0f} ms after the trigger."
    )


def wrong(each: Departure) -> str:
    """ "too low in ejection"."""
    way = "too high" if each.size > 0.0 else "too low"
    return f"{way} in {each.phase}" if each.phase else way


def unit_of(curve: str) -> tuple[str, float]:
    """Printed unit of a curve by name, and what one SI unit is in it."""
    return UNITS["m^3" if curve.endswith("_volume") else "Pa"]


def _ranking(diagnosis: Diagnosis) -> str:
    lines = [f"| {spoken(name)} | {value:.1f} |" for name, value in list(diagnosis.ranking.items())[:6]]
    return "| cause | ln Bayes factor over none |\n|---|---|\n" + "\n".join(lines)


def alternatives(diagnosis: Diagnosis) -> str:
    if diagnosis.withdrawn:
        return f"{', '.join(map(spoken, diagnosis.withdrawn))} fits, but did not help on what was held out: withdrawn."
    if diagnosis.verdict == "unknown":
        best = next(name for name in diagnosis.ranking if name != "unknown")
        return f"Nothing in the library: {spoken(best)}, the best of it, leaves more than noise."
    if not diagnosis.alternatives:
        return "Nothing in the library within a ln Bayes factor of 3."
    return "\n".join(f"- {' and '.join(map(spoken, each))}" for each in diagnosis.alternatives)


def in_three_dimensions(refitted: Refitted) -> str:
    """What the refit says of the extension, and of the parameters that it was not there to disturb."""
    added = " and ".join(sized(each) for each in refitted.extension)
    rest = "Both refits converged" if refitted.converged else "A refit was still moving at its last step"
    moved = [
        f"| {name} | {refitted.none[name]:.3g} | {value:.3g} | {100.0 * (value / refitted.none[name] - 1.0):+.0f} |"
        for name, value in refitted.extended.items()
    ]
    return (
        f"The model with {added} has a ln Bayes factor of {refitted.ln_bayes_factor:.1f} over the model without, both "
        f"fitted to half of the samples in {refitted.simulations} beats. {rest}.\n\n"
        "| parameter (SI) | without | with | change (%) |\n|---|---|---|---|\n" + "\n".join(moved)
    )


def gaining(diagnosis: Diagnosis) -> str:
    """ "the named cause", or what was tried in three dimensions though nothing is named."""
    if diagnosis.mechanisms or not diagnosis.refitted:
        return "the named cause"
    tried = " and ".join(spoken(each.name) for each in diagnosis.refitted.extension)
    return f"{tried}, which is not named but tried,"


def gains(found: Iterable[Gain]) -> str:
    lines = [
        f"- {CURVES.get(each.curve, each.curve)} ({each.on}): error times {each.ratio:.2f} "
        f"(95 % interval {each.interval[0]:.2f} to {each.interval[1]:.2f})"
        for each in found
    ]
    return "\n".join(lines) or "Nothing is named."
