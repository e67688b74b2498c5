"""Command that searches a recorded heart with the strain of its wall."""

import argparse
from pathlib import Path

from heartfit.cli.console import Command, add_configuration
from heartfit.core.errors import InputError
from heartfit.io.configuration import read_study
from heartfit.io.files import require_writable
from heartfit.io.fingerprint import fingerprint
from heartfit.io.meshes import read_mesh, read_motion


def wall_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `diagnose-wall`."""
    add_configuration(command)
    command.add_argument(
        "measured", type=Path, help="curves (.csv) as for `diagnose`: volumes, pressure if measured"
    )
    command.add_argument("--mesh", type=Path, required=True, help="ventricles (.vtu) in the first frame")
    command.add_argument(
        "--motion",
        type=Path,
        required=True,
        help="its nodes in all frames (.npz), as registration writes",
    )
    command.add_argument(
        "--noise",
        type=Path,
        help="noise of strain of that registration (.csv); that of the study if not given",
    )
    command.add_argument("--setting", default="physical", help="name of a setting of the configuration")
    command.add_argument(
        "-o", "--output", type=Path, default=Path("wall"), help="folder of the card and its figure"
    )


def diagnose_wall(arguments: argparse.Namespace) -> int:
    """Name the mechanism that a simulation lacks to explain volumes, pressures and the strain of the wall."""
    from heartfit.discovery.refit.model import activate
    from heartfit.discovery.wall_model import search
    from heartfit.discovery.wall_model.forward_model import WallForwardModel
    from heartfit.discovery.wall_model.wall_data import WallRecording
    from heartfit.io.recordings import read_recording
    from heartfit.io.regional_noise import LEARNED, read_regional_noise
    from heartfit.io.walls import write_wall
    from heartfit.results.wall_card import render_wall

    require_writable(arguments.output)
    study, curves = read_study(arguments.config), read_recording(arguments.measured)
    if arguments.setting not in study.settings:
        raise InputError(f"no setting {arguments.setting!r}; known are {', '.join(study.settings)}")
    mesh, motion = activate(read_mesh(arguments.mesh)), read_motion(arguments.motion)
    if motion.positions.shape[1] != len(mesh.points):
        raise InputError(
            f"{arguments.motion}: {motion.positions.shape[1]} nodes; expected the {len(mesh.points)} of the mesh: "
            "take the motion of this mesh"
        )
    recording = WallRecording(curves, mesh, motion, read_regional_noise(arguments.noise or LEARNED))
    heart = study.setting(arguments.setting).base_heart(curves.period)
    model = WallForwardModel.at_samples(recording, heart, study.end_diastolic_pressure)
    findings = search.search_wall(model, recording)
    rendered = render_wall(findings, f"The wall of {arguments.measured.name}")
    write_wall(arguments.output, rendered, fingerprint(Path(search.__file__)))
    print(f"{rendered.summary.sentence} See {arguments.output / 'wall.md'}.")
    return 0


COMMANDS: tuple[Command, ...] = (
    (diagnose_wall, wall_arguments, "name what a simulation lacks, the strain of a registered wall included"),
)
