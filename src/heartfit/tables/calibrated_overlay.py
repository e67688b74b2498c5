"""The calibrated simulation over the images that it was calibrated to (Fig. 5 of the paper)."""

from collections.abc import Iterable

from matplotlib.figure import Figure

from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.geometry.surface_distance import surface_distances
from heartfit.imaging.sequence import ImageSequence
from heartfit.tables.figures import CALIBRATED
from heartfit.tables.overlay import OUTLINES, Outlines, Overlay, Panel, draw_key, draw_phases

REGISTERED = "#56B4E9"  # the measured curves' black would not be seen


def plot_overlay(
    sequence: ImageSequence,
    mesh: VentricularMesh,
    registered: Motion,
    calibrated: Motion | None,
    title: str,
) -> Figure:
    """Outlines of the registered and the calibrated motion at end diastole and at the images' end systole.

    mesh: at end diastole; registered, calibrated: it in every frame of the images, None if the beat failed. Raises
    InputError if either is of other times.
    """
    overlay = Overlay(sequence, mesh, registered)
    figure = Figure(figsize=(10, 7), layout="constrained")
    panels = draw_phases(figure, overlay, dict.fromkeys(OUTLINES, REGISTERED))
    draw_key(figure, {"registered": REGISTERED, "calibrated simulation": CALIBRATED})
    said = "the calibrated beat failed"
    if calibrated is not None:
        simulated = Overlay(sequence, mesh, calibrated)
        _add(panels, simulated)
        said = _apart(overlay, simulated)
    figure.suptitle(f"{title}: {said}", fontsize=11)
    return figure


def _add(panels: Iterable[tuple[Panel, int]], calibrated: Overlay) -> None:
    """The calibrated outlines, over what the panels show."""
    colours = dict.fromkeys(OUTLINES, CALIBRATED)
    for panel, phase in panels:
        Outlines(panel.image.axes, calibrated, panel.view, colours).show(phase)


def _apart(registered: Overlay, calibrated: Overlay) -> str:
    """How far the left endocardia are apart at the registered end systole."""
    first, second = (each.motion.positions[registered.end_systole] for each in (registered, calibrated))
    distances, weights = surface_distances(first, second, registered.mesh.surfaces["lv_endo"])
    mean, most = 1e3 * (distances @ weights), 1e3 * distances.max()
    return f"at end systole the left endocardia are {mean:.1f} mm apart on average, {most:.1f} mm at most"
