"""Malformed recorded pressures of a measured heart, and malformed sources."""

import yaml

from tests.malformed.case import Content, Malformed, folder, pipe
from tests.malformed.pictures import pressure

CHECK = "check|--no-picture|--config|sound.yaml|own.yaml"
FILE = {"file": "p.csv", "trigger": "marker"}


def recorded(name: str, content: Content, message: str, **options: object) -> Malformed:
    source = {"mine": {"fit": "heart", "pressure": FILE | options}}
    files = {"own.yaml": yaml.safe_dump({"sources": source}), "p.csv": content}
    return Malformed(f"pressure: {name}", CHECK, message, files)


def source(name: str, text: str, message: str) -> Malformed:
    return Malformed(f"source: {name}", CHECK, message, {"own.yaml": f"sources: {text}\n"})


SOUND = pressure()
MALFORMED = [
    recorded("a folder", folder, "is a folder"),
    recorded("a pipe that nobody fills", pipe, "not a regular file"),
    recorded("empty", "", "empty"),
    recorded("one row", "time_s,lv_pressure_mmhg,marker\n0,8,1\n", "fewer than two"),
    recorded("Latin-1", SOUND.replace("marker", "m\xe4rker").encode("latin-1"), "not UTF-8"),
    recorded("decimal commas between commas", SOUND.replace(".", ","), "cells"),
    recorded("a row too short", SOUND + "2.1,8\n", "2 cells, expected 3"),
    recorded("a word", SOUND.replace(",8,", ",high,", 1), "is high; expected a finite number"),
    recorded("an empty cell", SOUND.replace(",8,", ",,", 1), "is empty; expected a finite number"),
    recorded("NaN", SOUND.replace(",8,", ",nan,", 1), "is nan; expected a finite number"),
    recorded("no unit of pressure", pressure("time_s,lv_pressure,marker"), "has no unit"),
    recorded("no unit of time", pressure("time,lv_pressure_mmhg,marker"), "columns of times with a unit"),
    recorded("another unit of pressure", pressure("time_s,lv_pressure_bar,marker"), "has no unit"),
    recorded("two units", SOUND, "and the stated unit kPa disagree", unit="kPa"),
    recorded("a unit that nobody knows", SOUND, "mmHg", unit="bar"),
    recorded(
        "millimetres of mercury called kilopascals",
        pressure("time_s,lv_pressure_kpa,marker"),
        "mmHg taken for kPa",
    ),
    recorded("kilopascals called millimetres of mercury", pressure(factor=7e-3), "pressure"),
    recorded(
        "seconds called milliseconds",
        pressure("time_ms,lv_pressure_mmhg,marker"),
        "the beats are|triggers|whole beat",
    ),
    recorded(
        "milliseconds called seconds", SOUND.replace("0.", "", 400), "increasing|next sample|columns|s from"
    ),
    recorded("times that go back", SOUND.replace("0.100,", "0.001,", 1), "increasing times"),
    recorded(
        "a gap",
        SOUND.replace("0.100,", "#", 1).replace("0.105,", "#").replace("0.110,", "#").replace("0.115,", "#"),
        "to the next sample",
    ),
    recorded("columns swapped", pressure("lv_pressure_mmhg,time_s,marker"), "increasing times"),
    recorded("marks that never come", SOUND.replace(",1\n", ",0\n"), "never rises"),
    recorded("one mark", pressure(rows=150), "triggers|whole beat"),
    recorded("a column that is not there", SOUND, "no column ecg", trigger="ecg"),
    recorded("a pressure that is not there", SOUND, "no column rv", column="rv"),
    recorded("two that say when a beat begins", SOUND, "leave one out", upstroke=0.05),
    recorded("nothing that says when a beat begins", SOUND, "neither trigger nor upstroke", trigger=None),
    recorded("a delay in milliseconds", SOUND, "delay", delay=20),
    recorded("a zero beyond all", SOUND, "pressure", zero=1e9),
    recorded("a zero of NaN", SOUND, "zero", zero=float("nan")),
    recorded("another heart rate", pressure(step=0.0065), "at the heart rate of the images"),
    source("of nobody", "{nobody: {fit: heart}}", "sources.nobody is of no measured case"),
    source("of a virtual case", "{volunteer5: {fit: heart}}", "is of no measured case"),
    source("nothing", "{mine: {}}", "no source"),
    source("two walls", "{mine: {fit: heart, surfaces: heart}}", "given for the wall"),
    source("a wall that is not there", "{mine: {fit: nowhere}}", "missing|no such"),
    source("a wall that is a file", "{mine: {fit: sound.csv}}", "missing|sound.csv"),
    source("an empty path", "{mine: {fit: ''}}", "fit"),
    source("a path with a NUL", '{mine: {fit: "a\\0b"}}', "mine"),
    source("a path of a thousand letters", f"{{mine: {{fit: {'x' * 300}}}}}", "mine|fit"),
    source("a key misspelt", "{mine: {fitt: heart}}", "did you mean fit"),
    source(
        "labels without a segmentation",
        "{mine: {fit: heart, labels: {lv_cavity: 1, lv_wall: 2, rv_cavity: 3}}}",
        "go together",
    ),
    source("a segmentation without labels", "{mine: {segmentation: sound.vtu}}", "go together"),
    source(
        "two labels of one number",
        "{mine: {segmentation: x, labels: {lv_cavity: 1, lv_wall: 1, rv_cavity: 3}}}",
        "share a number",
    ),
    source(
        "a label below nought",
        "{mine: {segmentation: x, labels: {lv_cavity: -1, lv_wall: 1, rv_cavity: 3}}}",
        "lv_cavity",
    ),
    source(
        "a label of a truth",
        "{mine: {segmentation: x, labels: {lv_cavity: yes, lv_wall: 2, rv_cavity: 3}}}",
        "lv_cavity",
    ),
    source("images that are not there", "{mine: {fit: heart, images: nowhere}}", "no such"),
    source(
        "a pressure that is not there", "{mine: {fit: heart, pressure: {file: none.csv}}}", "no such file"
    ),
    source("an end diastole of nothing", "{mine: {fit: heart, end_diastole: 3}}", "end_diastole"),
]
