"""A mechanism as the text of a Python file, from the law that a diagnosis suggests for an unknown effect."""

from collections.abc import Mapping
from dataclasses import dataclass
from textwrap import indent

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.cause import Diagnosis, RankedLaw
from heartfit.results.acting_places import acts

ONE_SIDED_LAWS = ("conductance", "orifice", "loss", "stiffening", "obliteration")
LEAST = -100.0
"""Least size of a law of any sign, over its scale."""


@dataclass(frozen=True)
class MechanismTemplate:
    """The role of a law's mechanism, its class attributes and its method; imports other than those of all."""

    role: str
    attributes: str
    method: str
    imports: tuple[str, ...] = ()


def mechanism_file(diagnosis: Diagnosis, title: str) -> str:
    """Return the text of a file that declares the best law of the best region as a mechanism.

    Its off value is 0, and the scale of its prior is the size that was found. Raises InputError without such a region.
    """
    if not diagnosis.acting:
        raise InputError(
            f"mechanism: the verdict of {title} is {diagnosis.verdict!r} without a place; expected an unknown effect "
            "that acts on a region: nothing is written"
        )
    acting = diagnosis.acting[0]
    law = acting.laws[0]
    name = f"Suggested{acting.region.capitalize()}{law.name.capitalize()}"
    return _text(name, law, TEMPLATES[acting.region][law.name], acts(acting.region), title, diagnosis.period)


def _text(
    name: str, law: RankedLaw, template: MechanismTemplate, words: str, title: str, period: float
) -> str:
    parameters = [_switch(law), *(_shape(*entry) for entry in law.shape.items())]
    imports = [
        "from dataclasses import dataclass",
        "",
        *(["import numpy as np", ""] if "np." in template.method else []),
        "from heartfit.core.arrays import Floats",
        "from heartfit.core.parameter import parameter, require_admissible",
        *template.imports,
        f"from heartfit.roles import {template.role}, mechanism",
    ]
    body = [
        f'r"""Acts {words}.',
        "",
        f".. math:: {law.formula}",
        "",
        f"Source: suggested by the diagnosis of {title}.",
        '"""',
        "",
        *template.attributes.splitlines(),
        *parameters,
        "",
        "def __post_init__(self) -> None:",
        "    require_admissible(self)",
        "",
        *template.method.replace("PERIOD", f"{period:.6g}").splitlines(),
    ]
    head = f'"""Unknown effect of {title}: a {law.name} law that acts {words}."""'
    declaration = f"@mechanism\n@dataclass(frozen=True)\nclass {name}({template.role}):\n"
    return "\n".join([head, "", *imports, "", "", declaration + indent("\n".join(body), "    ")]) + "\n"


def _switch(law: RankedLaw) -> str:
    size = float(f"{law.size:.3g}")
    low = "0.0" if law.name in ONE_SIDED_LAWS else f"{LEAST * abs(size):.3g}"
    return (
        f'size: float = parameter({size!r}, unit="{law.unit}", symbol="a", meaning="size of the law", off=0.0, '
        f"low={low}, scale={abs(size)!r})"
    )


UNITS = {"centre": "s", "width": "s", "decay": "s", "frequency": "Hz", "volume": "m^3", "growth": "m^3"}
"""Units of the shapes of laws, by name."""


def _shape(name: str, value: float) -> str:
    return (
        f'{name}: float = parameter({float(f"{value:.3g}")!r}, unit="{UNITS[name]}", symbol="{name[0]}", '
        f'meaning="{name} of the law", low=-1.0)'
    )


BUMP = ("from heartfit.core.periodic import bump",)
LAWS = ("from heartfit.roles.laws import Branch",)


def _flow(upstream: str, downstream: str, branch: str) -> MechanismTemplate:
    ends = f'upstream = "{upstream}"\ndownstream = "{downstream}"'
    imports = (*BUMP, *LAWS) if "bump" in branch else LAWS
    return MechanismTemplate(
        "Flow", ends, f"def law(self, time: Floats) -> Branch:\n    return Branch({branch})", imports
    )


def _flows(upstream: str, downstream: str) -> dict[str, MechanismTemplate]:
    return {
        "conductance": _flow(upstream, downstream, "conductance=self.size"),
        "orifice": _flow(upstream, downstream, "area=self.size"),
        "pulse": _flow(
            upstream, downstream, "source=self.size * bump(time, self.centre, self.width, PERIOD)"
        ),
    }


def _pressures(valve: str, compartment: str) -> dict[str, MechanismTemplate]:
    return {
        "loss": MechanismTemplate(
            "Narrowing", f'valve = "{valve}"', "def inverse_square(self) -> float:\n    return self.size"
        ),
        "pulse": MechanismTemplate(
            "Pressure",
            f'compartments = ("{compartment}",)',
            "def pressure(self, compartment: str, time: Floats, period: float) -> Floats:\n"
            "    return self.size * bump(time, self.centre, self.width, period)",
            BUMP,
        ),
    }


def _load(arguments: str, imports: tuple[str, ...] = ()) -> MechanismTemplate:
    method = (
        "def load(self, ventricle: str, time: Floats, period: float) -> Load:\n"
        f'    return Load({arguments}) if ventricle == "lv" else Load()'
    )
    return MechanismTemplate("External", "", method, (*imports, "from heartfit.roles.laws import Load"))


def _sensor(curve: str, distorted: str, imports: tuple[str, ...] = ()) -> MechanismTemplate:
    method = f"def distort(self, times: Floats, values: Floats, period: float) -> Floats:\n{indent(distorted, '    ')}"
    return MechanismTemplate("Sensor", f'measures = ("{curve}",)', method, imports)


def _sensors(curve: str) -> dict[str, MechanismTemplate]:
    return {
        "delay": _sensor(curve, "return np.interp(times - self.size, times, values, period=period)"),
        "pulse": _sensor(
            curve, "return values + self.size * bump(times, self.centre, self.width, period)", BUMP
        ),
    }


EXPONENTIAL = _load("rise=self.size, volume=self.volume, scale=self.growth")
TEMPLATES: Mapping[str, Mapping[str, MechanismTemplate]] = {
    "filling": _pressures("mitral", "left_atrium"),
    "ejection": _pressures("aortic", "aorta"),
    "leak": _flows("lv", "left_atrium"),
    "backflow": _flows("aorta", "lv"),
    "wall": {
        "stiffening": EXPONENTIAL,
        "obliteration": EXPONENTIAL,
        "pulse": _load("pulse=self.size * bump(time, self.centre, self.width, period)", BUMP),
    },
    "muscle": {
        "pulse": MechanismTemplate(
            "Attachment",
            "",
            "def added_integral(self, time: Floats) -> Floats:\n"
            "    since = np.clip(np.asarray(time) - self.centre + 0.5 * self.width, 0.0, self.width)\n"
            "    wave = np.sin(2.0 * np.pi * (since / self.width - 0.5)) * self.width / (2.0 * np.pi)\n"
            "    return self.size * 0.5 * (since + wave)",
        )
    },
    "images": {
        **_sensors("lv_volume"),
        "gain": _sensor("lv_volume", "return values + self.size * (values - values.mean())"),
        "bow": _sensor(
            "lv_volume",
            "high, low = values.max(), values.min()\n"
            "return values + 4.0 * self.size * (high - values) * (values - low) / (high - low)",
        ),
    },
    "catheter": {
        **_sensors("lv_pressure"),
        "offset": _sensor("lv_pressure", "return values + self.size"),
        "gain": _sensor("lv_pressure", "return values + self.size * (values - values.min())"),
        "ringing": _sensor(
            "lv_pressure",
            "since = np.mod(times - times[int(np.argmax(np.gradient(values, times)))], period)\n"
            "wave = np.exp(-since / self.decay) * np.sin(2.0 * np.pi * self.frequency * since)\n"
            "return values + self.size * wave",
        ),
    },
}  # fmt: skip
"""Templates by region and law."""
