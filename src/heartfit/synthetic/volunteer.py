"""Virtual volunteers: shape, mesh, hidden heart, and a beat of known truth.

Shapes of healthy hearts are drawn about normal values. One template mesh of an average wall is deformed to the wall of
every virtual heart.

The hidden heart differs from the calibrator's model on purpose, as a real heart does: valves obey Bernoulli's law
instead of a conductance, the number of bridges depends on length, the trigger comes earlier, and parameters that are
not estimated deviate from their standard values too. In a left bundle branch block the activation has other speeds,
although the same duration.

References
----------
Hudsmith LE et al. 2005, J Cardiovasc Magn Reson 7:775: volumes of both ventricles, women and men together. The other
numbers are those of a parametric ventricle with a plausible ejection fraction.
"""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.geometry.carry import boundary_surface, carry_nodes
from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import Motion, VentricularMesh, find_defect
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.surface import LabelledSurface
from heartfit.heart.activation.conduction import HEALTHY, LBBB, Conduction, assign_activation, fit_conduction
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.heart.circulation.elements import OrificeValve
from heartfit.heart.circulation.network import Circulation
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import PAPER_PARAMETERS, Heart
from heartfit.heart.simulation import simulate
from heartfit.personalise.numerics import Protocol as Protocol
from heartfit.roles import Mechanism

EDV, WALL, SPHERICITY, RIGHT_WALL, PERIOD = (
    (148e-6, 24e-6),
    (8.3e-3, 0.7e-3),
    (1.85, 0.08),
    (3.5e-3, 0.2e-3),
    (0.9, 0.07),
)
"""Mean and standard deviation of end-diastolic volume [m^3], wall thickness [m], sphericity [1], right wall thickness
[m] and period [s]."""

RIGHT_OVER_LEFT = (1.04, 0.04)
"""Mean and standard deviation of the ratio of right to left end-diastolic volume."""

TRUNCATION = 2.0
"""Truncation of a draw [standard deviations]."""


AVERAGE = ParametricVentricles(EDV[0], WALL[0], SPHERICITY[0], RIGHT_OVER_LEFT[0] * EDV[0], RIGHT_WALL[0])


@dataclass(frozen=True)
class Anatomy:
    """Shape of the ventricles, and the period of their beat [s]."""

    shape: ParametricVentricles
    period: float


def draw_anatomy(seed: int) -> Anatomy:
    """Draw the anatomy of this seed."""
    rng = np.random.default_rng(seed)

    def draw(mean: float, deviation: float) -> float:
        return mean + deviation * float(np.clip(rng.standard_normal(), -TRUNCATION, TRUNCATION))

    edv = draw(*EDV)
    right = edv * draw(*RIGHT_OVER_LEFT)
    shape = ParametricVentricles(edv, draw(*WALL), draw(*SPHERICITY), right, draw(*RIGHT_WALL))
    return Anatomy(shape, draw(*PERIOD))


TEMPLATE_ANGLE = np.deg2rad(10.0)
"""Smallest dihedral angle of a template [rad]; deformation to another shape reduces it."""


@dataclass(frozen=True, eq=False)
class Template:
    """Mesh of the average wall that is deformed to every virtual heart; edge length and tolerance of its mesher [m].

    The mesher takes seconds, a deformation a third of a second.
    """

    mesh: VentricularMesh
    edge_length: float
    tolerance: float

    @classmethod
    def build(cls, edge_length: float, tolerance: float) -> "Template":
        """Mesh the average wall; raises MeshingError as the mesher does."""
        from heartfit.geometry.mesher import fill_wall  # imported here: a deformation needs no mesher

        mesh = fill_wall(AVERAGE.surface(), edge_length, tolerance, TEMPLATE_ANGLE)
        return cls(mesh, edge_length, tolerance)

    def deformed_to(self, shape: ParametricVentricles) -> VentricularMesh:
        """Return the mesh deformed to the wall of this shape."""
        return self._carry(AVERAGE.surface(), shape.surface())

    def fill_wall_of(self, acquired: VentricularMesh, other: VentricularMesh) -> VentricularMesh:
        """Return the mesh deformed to the wall of ``acquired``, itself a deformation of the ``other`` template's mesh.

        Both meshes have the same wall surface; their interiors share nothing.
        """
        source, target = (boundary_surface(mesh, mesh.points) for mesh in (other, acquired))
        return self._carry(source, target)

    def _carry(self, source: LabelledSurface, target: LabelledSurface) -> VentricularMesh:
        """Deform the mesh from one surface to another; mesh the target anew if the deformation spoils the mesh."""
        defect = "the surfaces are numbered differently"
        if np.array_equal(source.triangles, target.triangles):
            mesh = self.mesh.with_points(carry_nodes(self.mesh, source, target.points[None])[0])
            defect = find_defect(mesh, target)
            if not defect:
                return mesh
        return self._remesh(target, defect)

    def _remesh(self, surface: LabelledSurface, defect: str) -> VentricularMesh:
        from heartfit.geometry.mesher import fill_wall

        warnings.warn(f"template does not fit: {defect}; the wall is meshed anew", stacklevel=2)
        return fill_wall(surface, self.edge_length, self.tolerance)


ESTIMATED = ("sigma_0", "mu", "c_1", "R_p")
OTHERS = ("k_RS", "k_ATP", "k_0", "alpha", "tau", "Z_c", "L")
ESTIMATED_SPREAD, OTHER_SPREAD = 0.15, 0.08
"""Standard deviations of the logarithms; healthy adults scatter less than the prior allows."""

VALVES = Circulation(
    mitral=OrificeValve(area=5e-4),
    aortic=OrificeValve(area=4e-4),
    tricuspid=OrificeValve(area=6e-4),
    pulmonary=OrificeValve(area=4e-4),
)
OTHER_MODEL = {"slope": 0.3, "trigger_delay": 0.03}
OTHER_CONDUCTIONS = {"healthy": HEALTHY, "lbbb": replace(LBBB, speed=0.5, ratio=0.5)}


def draw_heart(standard: Mapping[str, float], period: float, seed: int) -> tuple[Heart, dict[str, float]]:
    """Draw a heart around the ``standard`` values, and return it with its values of the paper's parameters."""
    return _scatter(standard, period, seed, dict.fromkeys(ESTIMATED, ESTIMATED_SPREAD))


def hide_heart(
    standard: Mapping[str, float],
    ratios: Mapping[str, float],
    period: float,
    seed: int,
    planted: Sequence[Mechanism] = (),
) -> tuple[Heart, dict[str, float]]:
    """Return a heart with estimated parameters ``ratios`` times the ``standard`` values, and the truth; others scatter.

    planted: mechanisms that the calibrator's model lacks.
    """
    values = Heart().with_parameters(standard)
    exact = {name: values.parameters()[values.parameter_path(name)] * ratio for name, ratio in ratios.items()}
    heart, truth = _scatter({**standard, **exact}, period, seed, {})
    for mechanism in planted:
        heart = heart + mechanism
    return heart, truth


def _scatter(
    standard: Mapping[str, float], period: float, seed: int, spreads: Mapping[str, float]
) -> tuple[Heart, dict[str, float]]:
    rng = np.random.default_rng(seed)
    heart = Heart(circulation=VALVES, period=period).with_parameters({**standard, **OTHER_MODEL})
    values = heart.parameters()
    drawn = {
        name: values[heart.parameter_path(name)] * float(np.exp(spread * rng.standard_normal()))
        for name, spread in {**spreads, **dict.fromkeys(OTHERS, OTHER_SPREAD)}.items()
    }
    heart = heart.with_parameters(drawn)
    return heart, {name: heart.parameters()[heart.parameter_path(name)] for name in PAPER_PARAMETERS}


@dataclass(frozen=True, eq=False)
class Volunteer:
    """Wall at end diastole (at the trigger), its beat, and the truth, which is reserved for evaluation."""

    mesh: VentricularMesh
    beat: Beat
    truth: dict[str, float]

    @property
    def motion(self) -> Motion:
        """Motion of the wall at every step of the beat."""
        return nodal_motion(self.beat)


class VolunteerError(RuntimeError):
    """Failed beat of a hidden heart."""


def generate(
    bare: VentricularMesh,
    hidden: tuple[Heart, dict[str, float]],
    protocol: Protocol,
    conduction: Conduction = HEALTHY,
    qrs: float | None = None,
) -> Volunteer:
    """Simulate the volunteer of this wall with the ``hidden`` heart and its truth.

    qrs: duration of the activation [s] if it was measured. Raises VolunteerError for a failed beat.
    """
    heart, truth = hidden
    prepared = prepare(bare)
    mesh = assign_activation(prepared, fit_conduction(prepared, conduction, qrs))
    reference = unload(mesh, heart.muscle, np.array(protocol.end_diastolic_pressure))
    body = FiniteElementBody(reference, heart.muscle)
    beat = simulate(heart, body, replace(protocol.numerics, keep_positions=True))
    if not beat.completed:
        raise VolunteerError(
            f"the beat of the hidden heart failed: {beat.reason}; choose another seed or shape"
        )
    return Volunteer(prepare(bare.with_points(nodal_motion(beat).at(0.0))), beat, truth)


def draw_volunteer(
    template: Template, standard: Mapping[str, float], seed: int, protocol: Protocol
) -> Volunteer:
    """Draw shape, period and heart of a volunteer, and simulate the volunteer."""
    anatomy = draw_anatomy(seed)
    hidden = draw_heart(standard, anatomy.period, seed)
    return generate(template.deformed_to(anatomy.shape), hidden, protocol)
