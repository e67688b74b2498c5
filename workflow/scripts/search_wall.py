"""Search for a mechanism that a case's model lacks, with the strain of its registered wall."""

from pathlib import Path

from heartfit.discovery.wall_model.forward_model import WallForwardModel
from heartfit.discovery.wall_model.search import search_wall
from heartfit.discovery.wall_model.wall_data import WallRecording
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.refits import read_measured_case
from heartfit.io.regional_noise import read_regional_noise
from heartfit.io.run import record
from heartfit.io.walls import write_wall
from heartfit.results.wall_card import render_wall

record(snakemake.log[0])
files, params, names = snakemake.input, snakemake.params, snakemake.wildcards
curves = read_measured_case(dict(files.items())).recording()
mesh, motion = read_mesh(Path(files.mesh)), read_motion(Path(files.registered))
recording = WallRecording(curves, mesh, motion, read_regional_noise())
heart = params.setting.base_heart(params.case.period)
findings = search_wall(WallForwardModel.at_samples(recording, heart, params.pressures), recording)
title = f"{names.case}, {names.setting} setting: search with the strain of the wall"
write_wall(Path(snakemake.output[0]).parent, render_wall(findings, title), params.code)
