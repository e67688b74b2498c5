"""Configuration of a whole study: meshes, numerics, observation, transform, cohort and settings."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Self

from pydantic import Field, field_validator, model_validator

from heartfit.core.validation import FigureFormats, Name, RelativeFolder, Strict
from heartfit.personalise.numerics import Generator, MeshSize, Operator, Pressures, TimeScheme, Transform
from heartfit.personalise.setting import Prior, Setting, require_known
from heartfit.study.case import Case, Source
from heartfit.study.discovery import Discovery, DiscoveryBenchmark
from heartfit.study.imaging import BASELINE, Acquisition, PressureLine, Registration, RegistrationError, flat
from heartfit.study.spheres import SensitivityStudy, SphereStudy
from heartfit.synthetic.scanner import Scanner

if TYPE_CHECKING:
    from heartfit.synthetic.known_hearts import KnownHeartSampler


class Cohort(Generator):
    """Generation and measurement of virtual volunteers, with a mesh and time step other than the calibrator's."""

    scanner: Acquisition = Acquisition()
    catheter: PressureLine = PressureLine()
    heart: dict[str, float] = Field({}, description="parameters around which the hidden hearts scatter")
    planted_ratios: bool = Field(
        default=True,
        description="the volunteers of the table of cases have the ratios of the paper's Table 2, so their spread "
        "confirms no claim of the paper",
    )


class Study(Strict):
    """Complete configuration of a study, as in config/config.yaml."""

    results: RelativeFolder = Field(
        "results", description="folder of all results, within the working directory"
    )
    cases: str = Field(description="table of the cases")
    reference: str = Field(description="folder of the stored tables to which `check_numbers` holds the study")
    measured_heart: str | None = Field(
        None, min_length=1, description="folder of the fit that serves measured cases without sources"
    )
    jitter: int = Field(0, ge=0, description="member of a perturbed ensemble; 0 moves nothing that jobs read")
    methods: bool = Field(
        False,
        description="also compare methods: of calibration, with its coverage, on spheres; Sobol's indices; images",
    )
    figures: FigureFormats = ("png",)
    sources: dict[str, Source] = Field({}, description="data of measured cases, by name")
    mesh: MeshSize = Field(description="mesh of a measured heart")
    virtual_mesh: MeshSize = Field(description="the calibrator's mesh of a virtual heart")
    numerics: TimeScheme
    observation: Operator
    unscented: Transform = Transform()
    end_diastolic_pressure: Pressures
    cohort: Cohort
    registration: Registration = Registration()
    measured_registration: Registration = Field(
        Registration(knots=0.02, stiffness=4e-8, incompressibility=0.1),
        description="registration of a measured cine with distant slices",
    )
    registration_error: RegistrationError
    sensitivity: SensitivityStudy
    sphere_study: SphereStudy
    discovery_benchmark: DiscoveryBenchmark
    discovery: Discovery = Discovery()
    prior: dict[str, Prior] = Field({}, description="priors that differ from the declared ones")
    settings: dict[Name, Setting] = Field(
        min_length=1,
        description="settings by name; null removes a setting of an earlier file, and those that are like it",
    )

    @field_validator("settings", mode="before")
    @classmethod
    def _drop_removed(cls, settings: Any) -> Any:
        if not isinstance(settings, Mapping):
            return settings
        removed = {name for name, setting in settings.items() if setting is None}
        kept = {name: setting for name, setting in settings.items() if name not in removed}
        models = {name: _stated(setting, "like") for name, setting in kept.items()}
        completed = {name: _completed(name, kept) for name in kept if models[name] not in removed}
        # those for all cases first, in whichever order files state them: others share what the first has perturbed
        return dict(sorted(completed.items(), key=lambda item: _stated(item[1], "cases") is not None))

    @model_validator(mode="after")
    def _names_are_known(self) -> Self:
        perturbed = (*self.sensitivity.parameters, *self.sensitivity.sphere.heart)
        for name in (*self.prior, *self.cohort.heart, *perturbed):
            require_known(name)
        for setting in self.settings.values():
            setting.with_lv_pressure().with_prior(self.prior)
        for name in self.settings:
            self.perturbation_setting(name)
            self.first_step(name)
        if all(setting.cases is not None for setting in self.settings.values()):
            raise ValueError("settings: each names its cases; expected one for all cases: omit its `cases`")
        known = ", ".join(self.settings)
        for name in self.discovery.settings:
            if name not in self.settings:
                raise ValueError(f"discovery.settings: no setting {name!r}; known settings are {known}")
            if self.settings[name].cases is not None:
                raise ValueError(f"discovery.settings: {name!r} is not for all cases; name one that is")
        stated = "element" in self.discovery.model_fields_set
        if stated and self.discovery.element.setting not in self.settings:
            raise ValueError(
                f"discovery.element: no setting {self.discovery.element.setting!r}; known settings are {known}"
            )
        nominal = self.discovery_benchmark.ventricles.setting
        if nominal not in self.settings:
            raise ValueError(
                f"discovery_benchmark.ventricles: no setting {nominal!r}; known settings are {known}"
            )
        self.nominal_setting()
        self.sphere_study.setting.with_lv_pressure().with_prior(self.prior)
        for name in self.registration_error.acquisitions():
            self._acquisition(name)
        return self

    def setting(self, name: str, case: Case | None = None) -> Setting:
        """Return the setting with its complete prior, for the measurements of this case."""
        setting = self.settings[name]
        observing = setting.with_lv_pressure() if case is not None and case.catheter else setting
        return observing.with_prior(self.prior)

    def element_setting(self) -> Setting:
        """Return the setting of the element comparison, with the study's prior instead of one tuned to the element."""
        setting = self.settings[self.discovery.element.setting].with_lv_pressure()
        return setting.model_copy(update={"prior": {}}).with_prior(self.prior)

    def nominal_setting(self) -> Setting:
        """Return the setting of the nominal beat, on which the sphere search of effects hidden in 3-D is centred."""
        ventricles = self.discovery_benchmark.ventricles
        setting = self.settings[ventricles.setting].model_dump()
        merged = setting | {"heart": {**setting["heart"], **ventricles.heart}}
        return Setting.model_validate(merged).with_prior(self.prior)

    def common_settings(self) -> tuple[str, ...]:
        """Return the names of the settings that are for all cases."""
        return tuple(name for name, setting in self.settings.items() if setting.cases is None)

    def settings_of(self, case: Case) -> tuple[str, ...]:
        """Return the names of the settings under which a case is calibrated: a sealed one as it is searched."""
        if case.kind == "sealed":
            return self.discovery.settings
        return tuple(name for name, setting in self.settings.items() if setting.serves(case.case))

    def calibrator(self, case: Case) -> Generator:
        """Return mesh and numerics of the model that is calibrated to a case."""
        if case.kind == "sealed" and self.discovery.coarse is not None:
            return self.discovery.coarse
        return Generator(mesh=self.virtual_mesh if case.virtual else self.mesh, numerics=self.numerics)

    def refitted(self, cases: Mapping[str, Case]) -> list[tuple[str, str]]:
        """Return the pairs of case and setting that are refitted and proved in three dimensions."""
        stated = self.discovery.cases
        names = (
            [
                name
                for name, case in cases.items()
                if case.kind == "sealed" or (not case.virtual and case.catheter)
            ]
            if stated is None
            else [name for name in stated if name in cases]
        )
        return [(name, setting) for name in names for setting in self.discovery.settings]

    def refit_model(self, case: Case) -> Generator:
        """Return mesh and numerics of the refits of a case."""
        return self.discovery.coarse or self.calibrator(case)

    def cohort_of(self, case: Case) -> Cohort:
        """Return the generation of a virtual case; a sealed one has mesh and numerics of its own."""
        generator = self.discovery.generator
        if case.kind != "sealed" or generator is None:
            return self.cohort
        return self.cohort.model_copy(update={"mesh": generator.mesh, "numerics": generator.numerics})

    def curves_besides(self, case: Case) -> tuple[str, ...]:
        """Return the curves that a setting of the case observes besides those of the left ventricle."""
        observed = (curve for name in self.settings_of(case) for curve in self.settings[name].observe)
        return tuple(dict.fromkeys(observed))

    def first_step(self, name: str) -> str:
        """Return the setting whose step starts at the prior: for two iterations the same setting with one, else itself.

        Raises ValueError where a setting of two iterations has no such partner for all its cases.
        """
        setting = self.settings[name]
        if setting.iterations == 1:
            return name
        once = setting.model_copy(update={"iterations": 1, "cases": None})
        for other, partner in self.settings.items():
            for_all = partner.cases is None
            serves = all(map(partner.serves, setting.cases)) if setting.cases else for_all
            if serves and partner.model_copy(update={"cases": None}) == once:
                return other
        raise ValueError(
            f"settings.{name}: a second iteration starts at the estimate of the first; expected the same setting with "
            f"one iteration for these cases: add it, or state `like: ...` with its name"
        )

    def perturbed_as(self, name: str) -> str:
        """Return the first setting of the same model and prior, whose perturbed beats serve this one too."""
        own = self.perturbation_setting(name)
        return next(other for other in self.settings if self.perturbation_setting(other) == own)

    def estimated(self) -> dict[str, tuple[tuple[str, ...], tuple[str, ...]]]:
        """Return by setting the parameters estimated from volume alone, and from volume and pressure."""
        return {
            name: (setting.estimate, setting.with_lv_pressure().estimate)
            for name, setting in self.settings.items()
        }

    def perturbation_setting(self, name: str) -> Setting:
        """Return the setting with all parameters of the sensitivity study free, for one-at-a-time perturbations."""
        return self.settings[name].with_estimated(self.sensitivity.parameters).with_prior(self.prior)

    def sphere_setting(self) -> Setting:
        """Return the setting with the same free parameters for a spherical left ventricle."""
        means = {name: Prior(mean=value) for name, value in self.sensitivity.sphere.heart.items()}
        content = {"element": "sphere", "estimate": self.sensitivity.parameters, "prior": means}
        return Setting.model_validate(content).with_prior(self.prior)

    def scanner(self, acquisition: str = BASELINE) -> Scanner:
        """Return the cohort's scanner, or that of a varied acquisition."""
        return self._acquisition(acquisition).scanner()

    def _acquisition(self, name: str) -> Acquisition:
        baseline = self.cohort.scanner
        if name == BASELINE:
            return baseline
        setting, value = self.registration_error.acquisitions()[name]
        typed = type(getattr(baseline, setting))(value)
        return Acquisition.model_validate(baseline.model_dump() | {setting: typed})

    def filling_pressures(self, case: Case) -> Pressures:
        """Return the end-diastolic pressures of a case; the left one of its row, if present, replaces the study's."""
        default = self.end_diastolic_pressure
        return default if case.edp is None else Pressures(lv=case.edp, rv=default.rv)

    def varied_settings(self) -> dict[str, float]:
        """Return the baseline value of each varied setting of the scanner."""
        return {name: getattr(self.cohort.scanner, name) for name in self.registration_error.varied}

    def protocol(self) -> dict[str, float | int | str | bool]:
        """Return all settings of scanner, catheter and registration, for which a noise model is valid."""
        return flat(
            {
                "scanner": self.cohort.scanner,
                "catheter": self.cohort.catheter,
                "registration": self.registration,
            }
        )

    def templates(self) -> dict[str, MeshSize]:
        """Return the mesh sizes of the templates of virtual hearts, by their use."""
        discovery = self.discovery
        return {
            "generator": self.cohort.mesh,
            "calibrator": self.virtual_mesh,
            "sealed": discovery.generator.mesh if discovery.generator else self.cohort.mesh,
            "coarse": discovery.coarse.mesh if discovery.coarse else self.virtual_mesh,
            "registration_error": self.registration_error.mesh,
            "planted": self.discovery_benchmark.ventricles.generator.mesh,
            "diagnoser": self.discovery_benchmark.ventricles.diagnoser.mesh,
        }

    def sigma_points(self, name: str, case: Case) -> Sequence[int]:
        """Return the indices of the 2n+1 sigma points of a case under a setting."""
        return range(2 * len(self.setting(name, case).estimate) + 1)

    def known_hearts(self) -> "dict[str, KnownHeartSampler]":
        """Return the samplers of the sphere study, by the measured curves."""
        features = self.observation.trial_features(self.observation.frames)
        features_by_name = {"volume": {"lv_volume": features["lv_volume"]}, "volume and pressure": features}
        pressure = self.end_diastolic_pressure.lv
        return {
            name: self.sphere_study.known_hearts(self.prior, operators, pressure)
            for name, operators in features_by_name.items()
        }


def _stated(setting: Any, field: str) -> Any:
    return setting.get(field) if isinstance(setting, Mapping) else None


def _completed(name: str, settings: Mapping[str, Any]) -> Any:
    """Return a stated setting with the fields of the one that it is like; that one is like no other."""
    setting, like = settings[name], _stated(settings[name], "like")
    if like is None:
        return setting
    model = settings.get(like) if isinstance(like, str) else None
    if not isinstance(model, Mapping) or _stated(model, "like") is not None:
        known = ", ".join(other for other in settings if other != name)
        raise ValueError(
            f"settings.{name}.like: {like!r}; expected a setting that is like no other, among {known}"
        )
    return {**model, **setting, "like": None}
