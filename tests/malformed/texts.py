"""Malformed configurations, tables of cases, sources, recorded pressures and recordings, and malformed arguments."""

import yaml

from tests.malformed.case import Content, Malformed, exchanged, hole, pipe
from tests.malformed.pictures import pressure
from tests.malformed.sound import CASES, CONFIGURATION, recording

CHECK = "check|--no-picture|--config|sound.yaml"
LAUGHS = "l0: &l0 [ha]\n" + "".join(f"l{n}: &l{n} [{', '.join([f'*l{n - 1}'] * 10)}]\n" for n in range(1, 30))
RECORDING = recording()
FILLED = exchanged(exchanged(CASES, "\tcatheter", "\tedp_kpa"), "5\thealthy\t\t", "5\thealthy\t\t12")
NUMERICS = "numerics:\n  time_step: 0.005\n  max_beats: 8\n  drift: 0.002"


def configuration(name: str, text: Content, message: str, **files: Content) -> Malformed:
    """A file that is laid over a sound configuration."""
    return Malformed(f"configuration: {name}", f"{CHECK}|bad.yaml", message, {"bad.yaml": text} | files)


def setting(name: str, text: str, message: str) -> Malformed:
    return configuration(name, f"settings: {{locking: {{{text}}}}}", message)


def table(name: str, old: str, new: str, message: str) -> Malformed:
    return Malformed(f"table of cases: {name}", CHECK, message, {"cases.tsv": exchanged(CASES, old, new)})


def source(name: str, text: str, message: str) -> Malformed:
    return Malformed(
        f"source: {name}", f"{CHECK}|own.yaml", message, {"own.yaml": f"sources: {{mine: {text}}}\n"}
    )


def recorded(name: str, content: Content, message: str, **options: object) -> Malformed:
    """A pressure recorded by a catheter."""
    stated = {"mine": {"fit": "heart", "pressure": {"file": "p.csv", "trigger": "marker"} | options}}
    files = {"own.yaml": yaml.safe_dump({"sources": stated}), "p.csv": content}
    return Malformed(f"pressure: {name}", f"{CHECK}|own.yaml", message, files)


def curves(name: str, content: Content, message: str) -> Malformed:
    return Malformed(f"recording: {name}", "diagnose|bad.csv", message, {"bad.csv": content})


def curves_with(name: str, old: str, new: str, message: str) -> Malformed:
    return curves(name, exchanged(RECORDING, old, new), message)


def scaled(column: int, factor: float) -> str:
    """The sound recording with the numbers of a column multiplied."""
    rows = [line.split(",") for line in RECORDING.splitlines()]
    for row in rows[2:]:
        row[column] = f"{factor * float(row[column]):.6g}"
    return "\n".join(map(",".join, rows)) + "\n"


def argued(arguments: str, message: str, **files: Content) -> Malformed:
    """A sound recording with malformed arguments."""
    return Malformed(f"arguments: {arguments[:60]!r}", arguments, message, files)


CONFIGURATIONS = [
    Malformed("configuration: missing", f"{CHECK}|none.yaml", "none.yaml: no such file"),
    configuration("a pipe that nobody fills", pipe, "not a regular file"),
    configuration("a hole of a terabyte", hole, "expected at most"),
    configuration("UTF-16", "mesh: {edge_length: 1}".encode("utf-16"), "not UTF-8"),
    configuration("cut off", '{"mesh": {"edge_length": 0.01', "not YAML"),
    configuration("a list", "- mesh\n", "holds a list"),
    configuration("a key twice", "mesh: {edge_length: 1}\nmesh: {tolerance: 1}\n", "key mesh .* twice"),
    configuration("a Python object", "results: !!python/object/apply:os.system ['touch hacked']\n", "tag"),
    configuration("a billion laughs", LAUGHS, "anchor|alias"),
    configuration("deep and closed", "mesh: " + "[" * 5_000 + "]" * 5_000, "nested"),
    configuration("an octal number", "sphere_study: {seed: 010}\n", "010, line 1, is read as 8"),
    configuration("digits apart", "sphere_study: {seed: '1_0'}\n", "1_0 is no number; expected digits"),
    configuration("a truth for a number", "cohort: {heart: {sigma_0: yes}}\n", "sigma_0"),
    configuration("a decimal comma", "mesh: {edge_length: '0,008'}\n", "edge_length = '0,008'"),
    configuration("NaN", "cohort: {heart: {sigma_0: .nan}}\n", "sigma_0"),
    configuration("millimetres", "mesh: {edge_length: 8}\n", "edge_length"),
    configuration("hearts without end", "registration_error: {sequences: 1000000000000}\n", "sequences"),
    configuration("a key misspelt", "mseh: {}\n", "unknown key mseh; did you mean mesh"),
    Malformed(
        "configuration: a table left out",
        "check|--no-picture|--config|bad.yaml",
        "numerics is missing",
        {"bad.yaml": exchanged(CONFIGURATION, NUMERICS, "")},
    ),
    configuration("a setting that is a path", "settings: {../x: {element: p1, estimate: [mu]}}\n", "name"),
    configuration(
        "a setting that is a folder", "settings: {geometry: {element: p1, estimate: [mu]}}\n", "geometry"
    ),
    setting("a mechanism that is none", "mechanisms: [MitralLeak]", "did you mean Mitral"),
    setting("a mechanism twice", "mechanisms: [MitralStenosis, MitralStenosis]", "twice"),
    configuration("a search of no setting", "discovery: {settings: [fysical]}\n", "known settings are"),
    configuration("an element of no setting", "discovery: {element: {setting: fysical}}\n", "fysical"),
    configuration("results outside", "results: a/../../outside\n", "results.* within"),
    configuration(
        "results behind a link",
        "results: away/results\n",
        "results.* within",
        away=lambda path: path.symlink_to("/tmp"),
    ),
]
TABLES_OF_CASES = [
    Malformed("table of cases: commas", CHECK, "no tabs", {"cases.tsv": CASES.replace("\t", ",")}),
    Malformed("table of cases: no rows", CHECK, "no case", {"cases.tsv": CASES.partition("\n")[0] + "\n"}),
    table("a quotation mark that is left open", "mine", '"mine', "cases.tsv"),
    table("a column without a name", "mu\tc_1", "mu\t", "no name"),
    table("milliseconds for seconds", "0.88", "880", "period"),
    Malformed("table of cases: mmHg for kPa", CHECK, "edp", {"cases.tsv": FILLED}),
    table("two cases of one name", "mine", "volunteer5", "two rows"),
    table("a period that the images contradict", "measured\t0.8", "measured\t0.9", "the same to 2 %"),
]
SOURCES = [
    source("a path of a thousand letters", f"{{fit: {'x' * 300}}}", "mine|fit"),
    recorded("mmHg called kPa", pressure("time_s,lv_pressure_kpa,marker"), "mmHg taken for kPa"),
    recorded("s called ms", pressure("time_ms,lv_pressure_mmhg,marker"), "the beats are|triggers|whole beat"),
    recorded("two units", pressure(), "and the stated unit kPa disagree", unit="kPa"),
]
RECORDINGS = [
    curves("missing", lambda path: None, "no such file"),
    curves_with("a row too short", "0.0900,142.361,", "0.0900,142.361\n", "2 cells, expected 3"),
    curves_with("NaN", "142.361", "nan", "is nan"),
    curves_with("a column without a unit", "lv_volume_ml", "lv_volume", "did you mean lv_volume_ml"),
    curves_with(
        "a curve in two units", "time_s,lv_volume_ml", "time_s,lv_pressure_mmhg", "pressure in two columns"
    ),
    curves_with("a flow", "lv_pressure_kpa", "aortic_flow_ml_per_s", "not searched"),
    curves_with("a period of dots", "= 0.9", "= 0.9.9", "period"),
    curves_with("a period in milliseconds", "= 0.9", "= 900", "period"),
    curves_with("two periods", "# period_s = 0.9\n", "# period_s = 0.9\n# period_s = 0.8\n", "period"),
    curves("milliseconds", scaled(0, 1e3), "milliseconds"),
    curves("litres", scaled(1, 1e-3), "L taken for mL"),
    curves("a loop that runs clockwise", recording(lead=-1 / 6), "clockwise"),
]
ARGUMENTS = [
    argued("diagnose|sound.csv|--against|sound.csv|--condition|legs=sound.csv", "without --condition"),
    argued("diagnose|sound.csv|--condition|sound.csv", "NAME=CSV"),
    argued("diagnose|sound.csv|-o|sound.yaml", "sound.yaml"),
    argued("diagnose|no\nwhere.csv", "no such file"),
    argued("diagnose|x\0.csv", "no such file|NUL|null"),
    argued("diagnose|x\udcff.csv", "no such file"),
    argued("diagnoze|sound.csv", "diagnoze"),
    argued("", "command"),
    argued("init|../mine", "expected a name"),
    argued("init|heart1", "config.yaml: no such file"),
    argued("simulate|none.vtu", "no such file"),
    argued("simulate|sound.vtu|--config|sound.yaml|--setting|fysical", "known are"),
    argued("simulate|sound.vtu|--config|sound.yaml|--set|sigma0=1", "nearest are"),
    argued("simulate|sound.vtu|--config|sound.yaml|--set|sigma_0=2,4e5", "NAME=VALUE"),
    argued("simulate|sound.vtu|--config|sound.yaml|--set|mu=1e4|mu=2e4", "twice"),
    argued("simulate|sound.vtu|--config|sound.yaml|--set|MitralRegurgitation.area=1", "MitralRegurgitation"),
    argued("simulate|sound.vtu|--period|829", "--period 829"),
    argued("simulate|sound.vtu|--output|beat.csv", "--output beat.csv"),
]
MALFORMED = [*CONFIGURATIONS, *TABLES_OF_CASES, *SOURCES, *RECORDINGS, *ARGUMENTS]
