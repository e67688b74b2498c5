"""The page of registrations, in Markdown."""

from collections.abc import Iterable, Mapping, Sequence
from importlib.metadata import version

import numpy as np

from benchmarks.page import machine
from benchmarks.registration.methods import OURS
from benchmarks.registration.row import Errors, Row

LIBRARIES = ("SimpleITK", "numpy", "scipy")
FRAMES, LIMIT = 25, 60.0
"""Of a case, and what it may take, CPU s."""

HEADER = """# Registrations beside each other

Which registration follows a heart, measured on synthetic cine of simulated beats (`heartfit.cohort.cine`: {frames}
frames, 2 mm isotropic, SNR 30, texture and valve plane as `Contrast` has them), whose motion is known. Everyone is
given the mesh at end diastole and the images and nothing else, carries the nodes, and is compared with where they were.
This page is written by `python -m benchmarks.registration` on {machine},
with {libraries}, one thread. The hearts, of 5k to 6k tetrahedra, are made by the
first run. What follows from it is in [decision 13](decisions/013-registration.md).

Errors of V_min, q_max and q_min of the left ventricle are relative; those of the points are distances of the nodes,
mean and 95 % over the beat without its first frame; "folded" is the largest number of inverted tetrahedra in a frame;
"shortening" (apex to rings) and "twist" are what is found at end systole.

## Methods

One heart of 160 mL. In truth it shortens by {shortening:.1f} % and twists by {twist:.1f} degrees. Each frame is
matched to end diastole from where its neighbour's search ended. Images are cropped 8 mm about the wall, brightness is
scaled to 1; lengths of demons are voxels of the level; "blank": brightness further than 4 mm from wall and blood of end
diastole is made constant; "near the wall" and ours: brightness is compared up to 4 mm from the wall, elsewhere at all
voxels. B-splines: mean squares over a fifth of these voxels (of all: a twentieth), seed fixed, LBFGSB. Affine maps
begin anew in each frame. "Refused": the wall would be folded, and ours says so.

| method | V_min % | q_max % | q_min % | points mm | 95 % mm | folded | shortening % | twist ° | CPU s a frame |
|---|---|---|---|---|---|---|---|---|---|
"""

CONTRASTS = """
## What the phantom gives away

Ours on {hearts} hearts, of which the first is the one above, with less of the muscle's texture (standard deviation over
mean brightness) and without what marks the valve plane: "neither" has leaflets as bright as blood and fat as dark as
lung. Shortening and twist are found less true, in percentage points and degrees.

| images | heart | V_min % | q_max % | q_min % | points mm | 95 % mm | folded | shortening | twist | CPU s a case |
|---|---|---|---|---|---|---|---|---|---|---|
"""

COST = """
## Cost and repeatability

A case of {frames} frames took {least:.1f} to {most:.1f} CPU s ({limit:g} are allowed), reading and writing files apart.
Its motion is {same} with one thread and with two.
"""


def page(methods: Mapping[str, Mapping[str, Row]], contrasts: Mapping[str, Sequence[Row]], same: bool) -> str:
    """The page; rows by family and name, and by contrast one for each heart; whether the bytes of a motion agree."""
    truth = methods["ours"][OURS].errors
    hearts = len(next(iter(contrasts.values())))
    costs = [(FRAMES - 1) * row.cpu for rows in contrasts.values() for row in rows]
    return "".join(
        [
            HEADER.format(
                frames=FRAMES,
                machine=machine(),
                libraries=", ".join(f"{name} {version(name)}" for name in LIBRARIES),
                shortening=100.0 * truth.true_shortening,
                twist=np.degrees(truth.true_twist),
            ),
            *(_method(family, name, row) for family, rows in methods.items() for name, row in rows.items()),
            CONTRASTS.format(hearts=hearts),
            *(
                _contrast(name, heart, row)
                for name, rows in contrasts.items()
                for heart, row in enumerate(rows, 1)
            ),
            COST.format(
                frames=FRAMES,
                least=min(costs),
                most=max(costs),
                limit=LIMIT,
                same="the same to the bit" if same else "**not** the same to the bit",
            ),
        ]
    )


def _method(family: str, name: str, row: Row) -> str:
    if row.errors is None:
        return _line([f"{family}: {name}", "refused", *8 * [""]])
    found = row.errors
    shape = [f"{100.0 * found.shortening:.1f}", f"{np.degrees(found.twist):.1f}"]
    return _line([f"{family}: {name}", *_numbers(found), *shape, f"{row.cpu:.2f}"])


def _contrast(name: str, heart: int, row: Row) -> str:
    if row.errors is None:
        return _line([name, str(heart), "refused", *8 * [""]])
    found = row.errors
    shortening = 100.0 * (found.shortening - found.true_shortening)
    twist = np.degrees(found.twist - found.true_twist)
    shape = [f"{shortening:+.1f}", f"{twist:+.1f}"]
    return _line([name, str(heart), *_numbers(found), *shape, f"{(FRAMES - 1) * row.cpu:.1f}"])


def _numbers(found: Errors) -> list[str]:
    percent = [f"{100.0 * value:+.1f}" for value in (found.V_min, found.q_max, found.q_min)]
    return [*percent, f"{1e3 * found.mean:.2f}", f"{1e3 * found.most:.1f}", str(found.folded)]


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |\n"
