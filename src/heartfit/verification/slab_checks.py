"""The eikonal solver at the far corner of the benchmark's slab, beside the closed form."""

from heartfit.verification.check import Check
from heartfit.verification.convergence import order
from heartfit.verification.slab import corner_error

EDGES = (1e-3, 0.5e-3, 0.25e-3)
KNOWN = 3e-3


def slab_checks() -> list[Check]:
    """Lateness at P8 and its order, with and without the neighbourhood of the stimulus given."""
    near = [corner_error(h, KNOWN) for h in EDGES]
    bare = [corner_error(h) for h in EDGES[1:]]
    closed = "closed form of straight rays"
    return [
        Check("slab: P8 late, h = 0.25 mm", 100 * bare[1], 0.0, 2.0, "%", closed),
        Check("slab: order at P8", order(*bare), 0.75, 0.25, "1", "h log(1/h) at the stimulated cube"),
        Check("slab: P8 late, h = 0.25 mm, 3 mm given", 100 * near[2], 0.0, 1.0, "%", closed),
        Check("slab: order at P8, 3 mm given", order(*near[1:]), 1.0, 0.15, "1", "linear elements, order 1"),
    ]
