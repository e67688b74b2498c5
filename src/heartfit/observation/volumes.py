"""Volume curves of both cavities from one mesh carried along the beat."""

from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.curve import Curve


def cavity_volumes(mesh: VentricularMesh, motion: Motion) -> dict[str, Curve]:
    """Curves "lv_volume" and "rv_volume", m^3, of the mesh in every phase of the motion."""
    return {f"{side}_volume": _volume(Cavity.of(mesh, f"{side}_endo"), motion) for side in ("lv", "rv")}


def _volume(cavity: Cavity, motion: Motion) -> Curve:
    volumes = [cavity.volume(positions) for positions in motion.positions]
    return Curve.of_volume(motion.times, volumes, motion.period)
