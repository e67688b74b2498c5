"""A whole study: meshes, numerics, observation, transform, cohort and settings."""

from collections.abc import Mapping, Sequence
from typing import Self

from pydantic import Field, PositiveFloat, PositiveInt, model_validator

from heartfit.calibration.unscented import Scaling
from heartfit.cohort.protocol import Protocol
from heartfit.configuration.setting import Prior, Setting, require_known
from heartfit.configuration.strict import Strict
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.vector import operators
from heartfit.simulation import Numerics


class MeshSize(Strict):
    """Wished edge length and how far the boundary may leave the measured surface."""

    edge_length: float = Field(gt=1e-3, lt=0.05, description="m")
    tolerance: float = Field(gt=1e-5, lt=5e-3, description="m")


class TimeScheme(Strict):
    """Step of the beat and when the beats count as periodic."""

    time_step: float = Field(gt=1e-5, le=0.02, description="s")
    second_order: bool = Field(True, description="BDF2 and midpoints of the fibres, or backward Euler")
    max_beats: PositiveInt
    drift: float = Field(gt=0, lt=1, description="largest relative change from beat to beat")

    def numerics(self) -> Numerics:
        """As the simulation takes it."""
        return Numerics(**self.model_dump())


class Operator(Strict):
    """How volume curves are observed; see heartfit.observation.operator."""

    frames: int = Field(ge=8)
    window: int = Field(ge=3, description="frames of the smoothing filter, odd")
    order: int = Field(ge=1)
    period_uncertainty: float = Field(ge=0, lt=0.5, description="relative standard deviation")

    def features(self, measured: Mapping[str, Curve]) -> dict[str, CurveFeatures]:
        """The operator of each curve that is observed: the LV's volume, and its pressure where measured."""
        return operators(measured, self.frames, self.window, self.order)


class Transform(Strict):
    """The numbers of the unscented transform, and whether bias and noise of the observations are used (R > 0)."""

    a: PositiveFloat = 1.0
    b: float = 2.0
    kappa: float = 0.0
    noise: bool = False

    def scaling(self) -> Scaling:
        """As the calibration takes it."""
        return Scaling(self.a, self.b, self.kappa)


class Pressures(Strict):
    """Pressures of the ventricles at end diastole, under which the measured mesh stands."""

    lv: float = Field(ge=0, lt=5e3, description="Pa")
    rv: float = Field(ge=0, lt=5e3, description="Pa")


class Cohort(Strict):
    """How virtual volunteers are made: not with the calibrator's mesh and time step."""

    mesh: MeshSize
    numerics: TimeScheme
    frames: int = Field(25, ge=8)
    noise: float = Field(ge=0, lt=5e-3, description="m, of the acquired wall in every frame")
    heart: dict[str, float] = Field({}, description="parameters about which the hidden hearts scatter")

    def protocol(self, pressures: Pressures) -> Protocol:
        """As the generator takes it."""
        return Protocol(
            self.mesh.edge_length,
            self.mesh.tolerance,
            self.numerics.numerics(),
            self.noise,
            (pressures.lv, pressures.rv),
            self.frames,
        )


class Study(Strict):
    """Everything config/config.yaml says."""

    results: str = Field("results", description="folder of all that is computed")
    cases: str = Field(description="table of the cases")
    measured_heart: tuple[str, ...] = Field(description="folders; the first that exists is used")
    mesh: MeshSize
    numerics: TimeScheme
    observation: Operator
    unscented: Transform = Transform()
    end_diastolic_pressure: Pressures
    cohort: Cohort
    prior: dict[str, Prior] = Field({}, description="where it differs from the declared one")
    settings: dict[str, Setting] = Field(min_length=1)

    @model_validator(mode="after")
    def _prior_is_known(self) -> Self:
        for name in (*self.prior, *self.cohort.heart):
            require_known(name)
        self.sigma_points()
        return self

    def setting(self, name: str) -> Setting:
        """The setting with its prior complete."""
        return self.settings[name].with_prior(self.prior)

    def sigma_points(self) -> dict[str, Sequence[int]]:
        """Indices of the 2n+1 sigma points of each setting."""
        return {name: range(2 * len(self.setting(name).estimate) + 1) for name in self.settings}
