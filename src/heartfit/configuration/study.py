"""A whole study: meshes, numerics, observation, transform, cohort and settings."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Self

from pydantic import Field, field_validator, model_validator

from heartfit.cohort.scanner import Scanner
from heartfit.configuration.case import Case
from heartfit.configuration.discovery import Discovery
from heartfit.configuration.fields import Inside, Name
from heartfit.configuration.generator import Generator, Pressures
from heartfit.configuration.imaging import (
    BASELINE,
    Acquisition,
    PressureLine,
    Registration,
    RegistrationError,
    flat,
)
from heartfit.configuration.numerics import MeshSize, TimeScheme
from heartfit.configuration.planting import DiscoveryBenchmark
from heartfit.configuration.sensitivity import SensitivityStudy
from heartfit.configuration.setting import Prior, Setting, require_known
from heartfit.configuration.source import Source
from heartfit.configuration.spheres import SphereStudy
from heartfit.configuration.strict import Strict
from heartfit.configuration.transform import Operator, Transform

if TYPE_CHECKING:
    from heartfit.twins.draw import Twins


class Cohort(Generator):
    """How virtual volunteers are made and measured: not with the calibrator's mesh and time step."""

    scanner: Acquisition = Acquisition()
    catheter: PressureLine = PressureLine()
    heart: dict[str, float] = Field({}, description="parameters about which the hidden hearts scatter")


class Study(Strict):
    """Everything config/config.yaml says."""

    results: Inside = Field(
        "results", description="folder of all that is computed, within the working directory"
    )
    cases: str = Field(description="table of the cases")
    tolerances: str = Field(description="table of the numbers that may not drift, and how far")
    measured_heart: tuple[str, ...] = Field(
        description="folders; the first that exists is used for measured cases without sources"
    )
    sources: dict[str, Source] = Field({}, description="the data of measured cases, by name")
    mesh: MeshSize = Field(description="of a measured heart")
    virtual_mesh: MeshSize = Field(description="of the calibrator's mesh of a virtual heart")
    numerics: TimeScheme
    observation: Operator
    unscented: Transform = Transform()
    end_diastolic_pressure: Pressures
    cohort: Cohort
    registration: Registration = Registration()
    measured_registration: Registration = Field(
        Registration(knots=0.02, stiffness=4e-8, incompressibility=0.1),
        description="of a measured cine whose slices lie far apart",
    )
    registration_error: RegistrationError
    sensitivity: SensitivityStudy
    sphere_study: SphereStudy
    discovery_benchmark: DiscoveryBenchmark
    discovery: Discovery = Discovery()
    prior: dict[str, Prior] = Field({}, description="where it differs from the declared one")
    settings: dict[Name, Setting] = Field(min_length=1, description="null leaves out one that stands below")

    @field_validator("settings", mode="before")
    @classmethod
    def _are_not_left_out(cls, settings: Any) -> Any:
        if not isinstance(settings, Mapping):
            return settings
        return {name: setting for name, setting in settings.items() if setting is not None}

    @model_validator(mode="after")
    def _prior_is_known(self) -> Self:
        tried = (*self.sensitivity.parameters, *self.sensitivity.sphere.heart)
        for name in (*self.prior, *self.cohort.heart, *tried):
            require_known(name)
        for setting in self.settings.values():
            setting.seeing_pressure().with_prior(self.prior)
        for name in self.settings:
            self.surroundings(name)
        for name in self.discovery.settings:
            if name not in self.settings:
                raise ValueError(f"discovery of {name!r}; known settings are {', '.join(self.settings)}")
        asked = "element" in self.discovery.model_fields_set
        if asked and self.discovery.element.setting not in self.settings:
            known = ", ".join(self.settings)
            raise ValueError(
                f"discovery.element of {self.discovery.element.setting!r}; known settings are {known}"
            )
        searched = self.discovery_benchmark.ventricles.setting
        if searched not in self.settings:
            known = ", ".join(self.settings)
            raise ValueError(f"discovery_benchmark of {searched!r}; known settings are {known}")
        self.centre()
        self.sphere_study.setting.seeing_pressure().with_prior(self.prior)
        for name in self.registration_error.acquisitions():
            self._acquisition(name)
        return self

    def setting(self, name: str, case: Case | None = None) -> Setting:
        """The setting with its prior complete, as it is for this case."""
        setting = self.settings[name]
        seen = setting.seeing_pressure() if case is not None and case.catheter else setting
        return seen.with_prior(self.prior)

    def questioned(self) -> Setting:
        """The setting whose element is asked about, with the study's prior not one that was found for the element."""
        setting = self.settings[self.discovery.element.setting].seeing_pressure()
        return setting.model_copy(update={"prior": {}}).with_prior(self.prior)

    def centre(self) -> Setting:
        """The setting of the beat on which a sphere is centred that searches for what is hidden in 3-D."""
        given = self.discovery_benchmark.ventricles
        setting = self.settings[given.setting].model_dump()
        changed = setting | {"heart": {**setting["heart"], **given.heart}}
        return Setting.model_validate(changed).with_prior(self.prior)

    def estimated(self) -> dict[str, tuple[tuple[str, ...], tuple[str, ...]]]:
        """By setting, what is estimated from volume alone and from volume and pressure."""
        return {
            name: (each.estimate, each.seeing_pressure().estimate) for name, each in self.settings.items()
        }

    def surroundings(self, name: str) -> Setting:
        """The setting with every parameter of the sensitivity study estimated."""
        return self.settings[name].estimating(self.sensitivity.parameters).with_prior(self.prior)

    def sphere(self) -> Setting:
        """The same parameters of a heart whose left ventricle is a sphere."""
        means = {name: Prior(mean=value) for name, value in self.sensitivity.sphere.heart.items()}
        parts = {"element": "sphere", "estimate": self.sensitivity.parameters, "prior": means}
        return Setting.model_validate(parts).with_prior(self.prior)

    def scanner(self, acquisition: str = BASELINE) -> Scanner:
        """The cohort's scanner, or that of another acquisition on which registration is tried."""
        return self._acquisition(acquisition).scanner()

    def _acquisition(self, name: str) -> Acquisition:
        usual = self.cohort.scanner
        if name == BASELINE:
            return usual
        setting, value = self.registration_error.acquisitions()[name]
        other = type(getattr(usual, setting))(value)
        return Acquisition.model_validate(usual.model_dump() | {setting: other})

    def filling(self, case: Case) -> Pressures:
        """The pressures under which a heart stands at end diastole: the left one of its row, where that says it."""
        usual = self.end_diastolic_pressure
        return usual if case.edp is None else Pressures(lv=case.edp, rv=usual.rv)

    def varied_settings(self) -> dict[str, float]:
        """The baseline's value of each setting of the scanner that is varied."""
        return {name: getattr(self.cohort.scanner, name) for name in self.registration_error.varied}

    def protocol(self) -> dict[str, float | int | str | bool]:
        """What a noise model was made for: every setting of scanner, catheter and registration."""
        return flat(
            {
                "scanner": self.cohort.scanner,
                "catheter": self.cohort.catheter,
                "registration": self.registration,
            }
        )

    def templates(self) -> dict[str, MeshSize]:
        """Sizes of the meshes that are moved to every virtual heart, by who computes on them."""
        return {
            "generator": self.cohort.mesh,
            "calibrator": self.virtual_mesh,
            "registration_error": self.registration_error.mesh,
            "planted": self.discovery_benchmark.ventricles.generator.mesh,
            "diagnoser": self.discovery_benchmark.ventricles.diagnoser.mesh,
        }

    def sigma_points(self, name: str, case: Case) -> Sequence[int]:
        """Indices of the 2n+1 sigma points of a case under a setting."""
        return range(2 * len(self.setting(name, case).estimate) + 1)

    def twins(self) -> "dict[str, Twins]":
        """Hearts of the sphere study by what is measured of them."""
        features = self.observation.trial_features(self.observation.frames)
        seen = {"volume": {"lv_volume": features["lv_volume"]}, "volume and pressure": features}
        pressure = self.end_diastolic_pressure.lv
        return {
            name: self.sphere_study.twins(self.prior, operators, pressure) for name, operators in seen.items()
        }
