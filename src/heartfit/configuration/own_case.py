"""The files of a study of one measured heart, as text: its configuration over the usual one, and its row."""

import json
from collections.abc import Mapping
from typing import Any

FILL_IN = "FILL_IN"
"""Stands where the user has still to say something; a study that holds it is refused there."""

HEAD = """\
# {case}, a measured heart, over config.yaml. Its files are named from the working directory on, and only read.
#   heartfit check {case}                                  says what is missing or wrong, draws what it understood
#   python3 study.py run --configfile config/{case}.yaml   runs the study
results: results/{case}
cases: config/{case}.tsv # one row: length of the beat; conduction: healthy, or lbbb with the duration of the QRS
settings:
  paper: null # the study's other setting, left out
sensitivity:
  case: {case}
"""

BLANK = f"""\
    segmentation: {FILL_IN} # label volume at end diastole
    labels: {{lv_cavity: {FILL_IN}, lv_wall: {FILL_IN}, rv_cavity: {FILL_IN}}} # its numbers; rv_wall too, if it has one
    images: {FILL_IN} # cine: a 4-D file, or a folder of DICOM
    end_diastole: 0 # frame of the images
    # instead of these four lines one of
    # surfaces: folder of surface meshes, one in each phase
    # fit: folder in the layout of a biv-me subject
"""

PRESSURE = """\
    # pressure: # of the left ventricle, if it was recorded
    #   file: pressure.csv # with columns such as time_ms, lv_pressure_mmhg, ecg
    #   unit: mmHg # or kPa, where the column's name does not say it
    #   trigger: ecg # the column of the ECG or of a marker; without one
    #   # upstroke: 0.08 # how long after the trigger the pressure rises fastest, s
"""


def study_text(case: str, source: Mapping[str, Any] | None) -> str:
    """The configuration in YAML; without a source, one to be filled in."""
    wall = BLANK if source is None else _lines(source)
    pressure = "" if source is not None and "pressure" in source else PRESSURE
    return f"{HEAD.format(case=case)}sources:\n  {case}:\n{wall}{pressure}"


def row_text(
    case: str, period: float | None, conduction: str | None, qrs_ms: float | None, filling: float | None
) -> str:
    """The table of cases with the one row; period in s, filling pressure in Pa."""
    cells = (
        case,
        "measured",
        FILL_IN if period is None else f"{period:.4g}",
        conduction or FILL_IN,
        "" if qrs_ms is None else f"{qrs_ms:g}",
        "" if filling is None else f"{1e-3 * filling:.4g}",
    )
    return "case\tkind\tperiod_s\tconduction\tqrs_ms\tedp_kpa\n" + "\t".join(cells) + "\n"


def _lines(source: Mapping[str, Any], indent: str = "    ") -> str:
    """A table of texts, numbers and further tables; JSON's quotes are YAML's too."""
    lines = ""
    for key, value in source.items():
        if isinstance(value, Mapping):
            lines += f"{indent}{key}:\n{_lines(value, indent + '  ')}"
        else:
            lines += f"{indent}{key}: {json.dumps(value, ensure_ascii=False)}\n"
    return lines
