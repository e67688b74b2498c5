r"""Two thick-walled spheres of one tissue, with the interface of the finite-element ventricles.

A sphere of mid-wall radius :math:`R_0` and thickness :math:`d_0` has the in-plane stretch
:math:`\Lambda = 1 + y/R_0` and, being incompressible, the radial stretch :math:`\Lambda^{-2}`:

.. math::
    V &= \tfrac43 \pi R_0^3 \Big(\Lambda - \frac{d_0}{2 R_0} \Lambda^{-2}\Big)^3, \qquad \Omega = 4\pi R_0^2 d_0 \\
    P \frac{dV}{dy} &= \frac{\Omega}{R_0} \Big[ \frac{dW}{d\Lambda} + \eta \dot E : \frac{\partial E}{\partial\Lambda}
        + \Lambda\, \overline{\sigma_{1D}} \Big]

The bar is the mean over fibres that are activated at different times, as in a ventricle. The muscle of the right sphere
may differ by the factors of :mod:`heartfit.heart.muscle.right`.
Source: Caruel et al., BMMB 13 (2014) 897, with version A of the fibre law.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.territory import ACTIVATION_ORDER
from heartfit.heart.finite_elements.body import StepFailed, Tissue
from heartfit.heart.muscle.bcs import Drive
from heartfit.heart.muscle.passive import Isotropic, require_isotropic
from heartfit.heart.time_step import STATIC_STEP, TimeStep

HEALTHY_ACTIVATION = np.linspace(0.0, 0.07, 8)
"""Activation times of the fibre classes in a healthy QRS complex [s]."""

SMALLEST_VOLUME, LARGEST_VOLUME = 1e-7, 1e-2
"""Bounds of the volumes of a cavity and of a wall [m^3]: 0.1 mL to 10 L."""

SMALLEST_STRETCH, LARGEST_STRETCH = 0.4, 2.0
"""Bounds of admissible stretches."""


@dataclass(frozen=True)
class Sphere:
    """Reference radius of the mid-wall and wall thickness [m]."""

    radius: float
    thickness: float

    @classmethod
    @lru_cache(maxsize=64)
    def from_volumes(cls, cavity: float, wall: float) -> "Sphere":
        """Sphere with the volumes ``cavity`` and ``wall`` [m^3]; kept, since many hearts of a search share it.

        Raises InputError for volumes that no ventricle has.
        """
        for name, volume in (("cavity", cavity), ("wall", wall)):
            if not SMALLEST_VOLUME <= volume <= LARGEST_VOLUME:
                raise InputError(
                    f"sphere: {name} = {volume:g} m^3; expected {SMALLEST_VOLUME:g} to {LARGEST_VOLUME:g} m^3: "
                    "convert it to m^3, 1 mL = 1e-6 m^3"
                )
        radius = brentq(lambda r: _cavity_volume(r, wall / (4.0 * np.pi * r * r), 1.0) - cavity, 1e-3, 1.0)
        return cls(radius, wall / (4.0 * np.pi * radius**2))

    @classmethod
    def unloaded(
        cls, cavity: float, wall: float, pressure: float, passive: Isotropic, scale: float = 1.0
    ) -> "Sphere":
        """Stress-free sphere whose cavity has the volume ``cavity`` [m^3] under ``pressure`` [Pa].

        ``scale`` multiplies the moduli of the ``passive`` law.
        """

        def excess(smaller: float) -> float:
            sphere = cls.from_volumes(smaller, wall)
            ratio = 0.5 * sphere.thickness / sphere.radius
            stretch = brentq(lambda s: _cavity_volume(sphere.radius, sphere.thickness, s) - cavity, 1.0, 3.0)
            slope = 4.0 * np.pi * sphere.radius**3 * (stretch - ratio * stretch**-2) ** 2
            slope *= 1.0 + 2.0 * ratio * stretch**-3
            return float(sphere.wall * passive.in_plane_stress(np.array(stretch), scale) - pressure * slope)

        return cls.from_volumes(brentq(excess, 0.2 * cavity, (1.0 - 1e-9) * cavity), wall)

    @property
    def wall(self) -> float:
        """Wall volume [m^3]."""
        return 4.0 * np.pi * self.radius**2 * self.thickness


def _cavity_volume(radius: float, thickness: float, stretch: float) -> float:
    inner = stretch - 0.5 * thickness / radius * stretch**-2
    return 4.0 / 3.0 * np.pi * radius**3 * float(np.sign(inner)) * abs(inner) ** 3


def fibre_class_means(regional: Floats, classes: int, sides: int) -> Floats:
    """Means (sides classes,) of ``regional`` values (18,) over the fibre classes of the spheres.

    The classes of the left sphere divide the 17 segments, in the order of activation, into equal shares; the right
    sphere is the right ventricular wall.
    """
    cumulative = np.concatenate([[0.0], np.cumsum(regional[ACTIVATION_ORDER])])
    ends = np.interp(
        np.linspace(0.0, len(ACTIVATION_ORDER), classes + 1),
        np.arange(len(ACTIVATION_ORDER) + 1.0),
        cumulative,
    )
    means = np.diff(ends) * classes / len(ACTIVATION_ORDER)
    return np.concatenate([means, np.full(classes, regional[0])])[: sides * classes]


def fibre_activation(tissue: Tissue, activation: Floats, sides: int) -> tuple[Floats, Floats]:
    """Activation times (sides k,) [s] of the fibres of the spheres, and shares (sides k,) of their bridges that remain.

    ``activation`` (k,) are the times of the fibre classes of one sphere in health [s].
    """
    times = np.tile(activation, sides)
    if tissue.uniform:
        return times, np.ones(len(times))
    delays, losses = (
        fibre_class_means(regional, len(activation), sides) for regional in (tissue.delays(), tissue.losses())
    )
    return times + delays, 1.0 - losses


def wall_stiffenings(tissue: Tissue, sides: int) -> Floats:
    """Factors (sides,) on the passive moduli of the spheres."""
    return np.array([1.0, tissue.right.stiffness])[:sides]


@dataclass(frozen=True, eq=False)
class SphereState:
    """Displacements ``x`` (2, 1) [m] of the mid-walls and fibre states (4, 2 k) at one time.

    ``stress`` (2 k,) is the mean fibre stress [Pa] during the last step, ``x_before`` is x at its start.
    """

    x: Floats
    fibres: Floats
    stress: Floats
    x_before: Floats


class SphericalBody:
    """Spherical left and right ventricle; see the equations of the module."""

    def __init__(
        self, left: Sphere, right: Sphere, tissue: Tissue, activation: Floats = HEALTHY_ACTIVATION
    ) -> None:
        self.tissue = tissue
        self.activation, self.kept = fibre_activation(tissue, activation, 2)
        self.passive, self.stiffening = require_isotropic(tissue.passive), wall_stiffenings(tissue, 2)
        self.radius = np.array([left.radius, right.radius])
        self.ratio = np.array([0.5 * s.thickness / s.radius for s in (left, right)])
        self.wall = np.array([left.wall, right.wall])

    def rest(self) -> SphereState:
        x, k = np.zeros((2, 1)), len(self.activation)
        return SphereState(x, self.tissue.active.rest(k), np.zeros(k), x)

    def stretch(self, x: Floats) -> Floats:
        r"""Stretches :math:`\Lambda` (2,)."""
        return 1.0 + x[:, 0] / self.radius

    def volumes(self, x: Floats) -> Floats:
        stretch = self.stretch(x)
        result: Floats = 4.0 / 3.0 * np.pi * self.radius**3 * (stretch - self.ratio * stretch**-2) ** 3
        return result

    def volume_gradients(self, x: Floats) -> Floats:
        stretch = self.stretch(x)
        inner = stretch - self.ratio * stretch**-2
        slope = 4.0 * np.pi * self.radius**2 * inner**2 * (1.0 + 2.0 * self.ratio * stretch**-3)
        return np.diag(slope)

    def wall_volume(self, x: Floats) -> float:  # noqa: ARG002
        return float(self.wall.sum())

    def step(self, state: SphereState, step: TimeStep) -> "SphereStep":
        control = self.tissue.control.mean(step.start, step.length, self.activation, step.period)
        return SphereStep(self, state, step, self.tissue.active.drive(step, control, state.fibres, self.kept))

    def static_step(self, state: SphereState) -> "SphereStep":
        zeros = np.zeros(len(self.activation))
        return SphereStep(self, state, STATIC_STEP, Drive(zeros, zeros, zeros, np.inf))


class SphereStep:
    """Forces and stiffness of both spheres at the end of one step."""

    def __init__(self, body: SphericalBody, state: SphereState, time_step: TimeStep, drive: Drive) -> None:
        self.body, self.state, self.time_step, self.drive = body, state, time_step, drive
        old, before = body.stretch(state.x), body.stretch(state.x_before)
        self._e_old = np.repeat(0.5 * (old * old - 1.0), len(body.activation) // 2)
        self._fibre = body.tissue.active.begin(self._e_old, state.fibres)
        self._plane = time_step.starting_value(old**2, before**2)
        self._radial = time_step.starting_value(old**-4, before**-4)

    def forces(self, x: Floats) -> Floats:
        """Internal forces (2,) [N], conjugate to the displacements of the mid-walls."""
        stretch = self.body.stretch(x)
        if not ((stretch > SMALLEST_STRETCH) & (stretch < LARGEST_STRETCH)).all():
            raise StepFailed(
                f"the spheres are stretched to {stretch.round(3)} times their reference radii: expected "
                f"{SMALLEST_STRETCH:g} to {LARGEST_STRETCH:g}"
            )
        self._respond(stretch)
        passive, viscous = self.body.passive, self._viscous(stretch)[0]
        stress = (
            passive.in_plane_stress(stretch, self.body.stiffening) + viscous + stretch * self._tension()[0]
        )
        return self.body.wall / self.body.radius * stress

    def _respond(self, stretch: Floats) -> None:
        new = np.repeat(0.5 * (stretch * stretch - 1.0), len(self.body.activation) // 2)
        self.body.tissue.active.respond(self.drive, self._e_old, new, self.state.fibres, self._fibre)

    def _tension(self) -> tuple[Floats, Floats]:
        """Mean fibre stress (2,) [Pa] of the spheres at the end of the step, and its derivative by the strain."""
        stress = self.time_step.end_value(self._fibre[0], self.state.stress)
        slope = (1.0 + self.time_step.memory) * self._fibre[1]
        return stress.reshape(2, -1).mean(axis=1), slope.reshape(2, -1).mean(axis=1)

    def _viscous(self, stretch: Floats) -> tuple[Floats, Floats]:
        rate = self.body.tissue.passive.eta / self.time_step.effective
        plane, radial = 0.5 * (stretch**2 - self._plane), 0.5 * (stretch**-4 - self._radial)
        stress = rate * (2.0 * plane * stretch - 2.0 * radial * stretch**-5)
        slope = rate * (2.0 * plane + 2.0 * stretch**2 + 10.0 * radial * stretch**-6 + 4.0 * stretch**-10)
        return stress, slope

    def tangent(self, x: Floats) -> "Stiffness":
        """Derivative of the forces at ``x``, at which they were last evaluated."""
        stretch = self.body.stretch(x)
        slope = (
            self.body.passive.in_plane_stiffness(stretch, self.body.stiffening) + self._viscous(stretch)[1]
        )
        tension, stiffness = self._tension()
        slope = slope + stretch**2 * stiffness + tension
        return Stiffness(self.body.wall / self.body.radius**2 * slope)

    def commit(self, x: Floats) -> SphereState:
        fibres = self.body.tissue.active.advance(self.drive, self.state.fibres, self._fibre[2])
        return SphereState(x.copy(), fibres, self._fibre[0].copy(), self.state.x)

    def size(self, residual: Floats) -> float:
        return float(np.linalg.norm(residual))

    def weights(self, x: Floats) -> Floats:
        return np.full_like(x, 1e3)


@dataclass(frozen=True, eq=False)
class Stiffness:
    """Diagonal stiffness [N/m]."""

    diagonal: Floats

    def solve(self, right: Floats) -> Floats:
        scale = self.diagonal if right.ndim == 1 else self.diagonal[:, None]
        result: Floats = right / scale
        return result
