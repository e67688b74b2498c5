r"""Two thick-walled spheres of the same tissue law, in the slot of the finite-element ventricles.

A sphere of mid-wall radius :math:`R_0` and thickness :math:`d_0` has the in-plane stretch
:math:`\Lambda = 1 + y/R_0` and, being incompressible, the radial stretch :math:`\Lambda^{-2}`:

.. math::
    V &= \tfrac43 \pi R_0^3 \Big(\Lambda - \frac{d_0}{2 R_0} \Lambda^{-2}\Big)^3, \qquad \Omega = 4\pi R_0^2 d_0 \\
    P \frac{dV}{dy} &= \frac{\Omega}{R_0} \Big[ \frac{dW}{d\Lambda} + \eta \dot E : \frac{\partial E}{\partial\Lambda}
        + \Lambda\, \overline{\sigma_{1D}} \Big]

The bar is the mean over fibres that are activated at different times, as those of a ventricle are.
Source: Caruel et al., BMMB 13 (2014) 897, with version A of the fibre law.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from heartfit.geometry.arrays import Floats
from heartfit.mechanics.active.bcs import Drive
from heartfit.mechanics.body import StepFailed, Tissue
from heartfit.mechanics.passive.law import Isotropic, isotropic
from heartfit.mechanics.time_step import ENDLESS, TimeStep

ACTIVATION = np.linspace(0.0, 0.07, 8)
"""Activation times of the fibres, s: a healthy QRS complex."""

ORDER = [9, 8, 14, 7, 15, 10, 13, 17, 16, 11, 12, 1, 2, 3, 4, 6, 5]
"""AHA segments as a healthy heart activates them, septum first and lateral base last; fibre classes follow them."""

SMALLEST_STRETCH, LARGEST_STRETCH = 0.4, 2.0


@dataclass(frozen=True)
class Sphere:
    """Reference radius of the mid-wall and wall thickness, m."""

    radius: float
    thickness: float

    @classmethod
    def of(cls, cavity: float, wall: float) -> "Sphere":
        """The sphere with the given volumes of cavity and wall, m^3."""
        radius = brentq(lambda r: _cavity(r, wall / (4.0 * np.pi * r * r), 1.0) - cavity, 1e-3, 1.0)
        return cls(radius, wall / (4.0 * np.pi * radius**2))

    @classmethod
    def unloaded(cls, cavity: float, wall: float, pressure: float, passive: Isotropic) -> "Sphere":
        """The stress-free sphere whose cavity has the volume ``cavity``, m^3, under ``pressure``, Pa."""

        def excess(smaller: float) -> float:
            sphere = cls.of(smaller, wall)
            ratio = 0.5 * sphere.thickness / sphere.radius
            stretch = brentq(lambda s: _cavity(sphere.radius, sphere.thickness, s) - cavity, 1.0, 3.0)
            slope = 4.0 * np.pi * sphere.radius**3 * (stretch - ratio * stretch**-2) ** 2
            slope *= 1.0 + 2.0 * ratio * stretch**-3
            return float(sphere.wall * passive.in_plane_stress(np.array(stretch)) - pressure * slope)

        return cls.of(brentq(excess, 0.2 * cavity, (1.0 - 1e-9) * cavity), wall)

    @property
    def wall(self) -> float:
        """Wall volume, m^3."""
        return 4.0 * np.pi * self.radius**2 * self.thickness


def _cavity(radius: float, thickness: float, stretch: float) -> float:
    inner = stretch - 0.5 * thickness / radius * stretch**-2
    return 4.0 / 3.0 * np.pi * radius**3 * float(np.sign(inner)) * abs(inner) ** 3


def of_fibres(regional: Floats, classes: int, sides: int) -> Floats:
    """Means (sides classes,) of what is known of the regions (18,) over the fibre classes of the spheres.

    A class of the left sphere is as many segments as its share of the fibres, in their order; the right sphere is the
    right ventricular wall.
    """
    filled = np.concatenate([[0.0], np.cumsum(regional[ORDER])])
    ends = np.interp(np.linspace(0.0, len(ORDER), classes + 1), np.arange(len(ORDER) + 1.0), filled)
    means = np.diff(ends) * classes / len(ORDER)
    return np.concatenate([means, np.full(classes, regional[0])])[: sides * classes]


def fibres_of(tissue: Tissue, activation: Floats, sides: int) -> tuple[Floats, Floats]:
    """When the fibres (sides k,) of so many spheres are activated, s, and which share of their bridges is kept.

    ``activation`` (k,) are the times of the classes of each sphere in health.
    """
    times = np.tile(activation, sides)
    if not tissue.regional:
        return times, np.ones(len(times))
    delays, losses = (of_fibres(each, len(activation), sides) for each in (tissue.delays(), tissue.losses()))
    return times + delays, 1.0 - losses


@dataclass(frozen=True, eq=False)
class SphereState:
    """Displacements ``x`` (2, 1) of the mid-walls and fibre states (4, 2 k) at one time.

    ``stress`` (2 k,) is the mean fibre stress of the step that led here, ``x_before`` what x was at its start.
    """

    x: Floats
    fibres: Floats
    stress: Floats
    x_before: Floats


class SphericalBody:
    """A left and a right ventricle, each a sphere; see the module's equations."""

    def __init__(self, left: Sphere, right: Sphere, tissue: Tissue, activation: Floats = ACTIVATION) -> None:
        self.tissue = tissue
        self.activation, self.kept = fibres_of(tissue, activation, 2)
        self.passive = isotropic(tissue.passive)
        self.radius = np.array([left.radius, right.radius])
        self.ratio = np.array([0.5 * s.thickness / s.radius for s in (left, right)])
        self.wall = np.array([left.wall, right.wall])

    def rest(self) -> SphereState:
        x, k = np.zeros((2, 1)), len(self.activation)
        return SphereState(x, self.tissue.active.rest(k), np.zeros(k), x)

    def stretch(self, x: Floats) -> Floats:
        r""":math:`\Lambda` (2,)."""
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

    def endless_step(self, state: SphereState) -> "SphereStep":
        none = np.zeros(len(self.activation))
        return SphereStep(self, state, ENDLESS, Drive(none, none, none, np.inf))


class SphereStep:
    """Forces and stiffness of both spheres at the end of one step."""

    def __init__(self, body: SphericalBody, state: SphereState, time_step: TimeStep, drive: Drive) -> None:
        self.body, self.state, self.time_step, self.drive = body, state, time_step, drive
        old, before = body.stretch(state.x), body.stretch(state.x_before)
        self._e_old = np.repeat(0.5 * (old * old - 1.0), len(body.activation) // 2)
        self._fibre = body.tissue.active.begin(self._e_old, state.fibres)
        self._plane = time_step.shifted(old**2, before**2)
        self._radial = time_step.shifted(old**-4, before**-4)

    def forces(self, x: Floats) -> Floats:
        """Internal forces (2,), conjugate to the displacements of the mid-walls."""
        stretch = self.body.stretch(x)
        if not ((stretch > SMALLEST_STRETCH) & (stretch < LARGEST_STRETCH)).all():
            raise StepFailed(f"the spheres are stretched to {stretch.round(3)} of their reference radii")
        self._respond(stretch)
        passive, viscous = self.body.passive, self._viscous(stretch)[0]
        stress = passive.in_plane_stress(stretch) + viscous + stretch * self._tension()[0]
        return self.body.wall / self.body.radius * stress

    def _respond(self, stretch: Floats) -> None:
        new = np.repeat(0.5 * (stretch * stretch - 1.0), len(self.body.activation) // 2)
        self.body.tissue.active.respond(self.drive, self._e_old, new, self.state.fibres, self._fibre)

    def _tension(self) -> tuple[Floats, Floats]:
        """Mean fibre stress (2,) of the spheres at the end of the step, and its derivative by the strain."""
        stress = self.time_step.at_end(self._fibre[0], self.state.stress)
        slope = (1.0 + self.time_step.memory) * self._fibre[1]
        return stress.reshape(2, -1).mean(axis=1), slope.reshape(2, -1).mean(axis=1)

    def _viscous(self, stretch: Floats) -> tuple[Floats, Floats]:
        rate = self.body.tissue.passive.eta / self.time_step.effective
        plane, radial = 0.5 * (stretch**2 - self._plane), 0.5 * (stretch**-4 - self._radial)
        stress = rate * (2.0 * plane * stretch - 2.0 * radial * stretch**-5)
        slope = rate * (2.0 * plane + 2.0 * stretch**2 + 10.0 * radial * stretch**-6 + 4.0 * stretch**-10)
        return stress, slope

    def tangent(self, x: Floats) -> "Stiffness":
        """Derivative of the forces where they were last evaluated, which is ``x``."""
        stretch = self.body.stretch(x)
        slope = self.body.passive.in_plane_stiffness(stretch) + self._viscous(stretch)[1]
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
    """A diagonal stiffness, N/m."""

    diagonal: Floats

    def solve(self, right: Floats) -> Floats:
        scale = self.diagonal if right.ndim == 1 else self.diagonal[:, None]
        result: Floats = right / scale
        return result
