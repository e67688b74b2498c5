"""Malformed configurations."""

from tests.malformed.case import Content, Malformed, folder, hole, pipe
from tests.malformed.sound import CONFIGURATION

CHECK = "check|--no-picture|--config|sound.yaml|bad.yaml"
LAUGHS = "l0: &l0 [ha]\n" + "".join(f"l{n}: &l{n} [{', '.join([f'*l{n - 1}'] * 10)}]\n" for n in range(1, 30))


def over(name: str, text: Content, message: str) -> Malformed:
    """A file that is laid over a sound configuration."""
    return Malformed(f"configuration: {name}", CHECK, message, {"bad.yaml": text})


def whole(name: str, old: str, new: str, message: str) -> Malformed:
    """A sound configuration with a part replaced."""
    assert old in CONFIGURATION, old
    text = CONFIGURATION.replace(old, new, 1)
    return Malformed(
        f"configuration: {name}", "check|--no-picture|--config|bad.yaml", message, {"bad.yaml": text}
    )


def setting(name: str, text: str, message: str) -> Malformed:
    return over(name, f"settings: {{locking: {{{text}}}}}", message)


MALFORMED = [
    # no configuration at all
    Malformed("configuration: missing", "check|--no-picture|--config|none.yaml", "none.yaml: no such file"),
    over("a folder", folder, "bad.yaml: is a folder"),
    over("a device", lambda path: path.symlink_to("/dev/zero"), "not a regular file"),
    over("a pipe that nobody fills", pipe, "not a regular file"),
    over("a link to itself", lambda path: path.symlink_to(path), "bad.yaml"),
    over("bytes", bytes(range(256)), "not UTF-8"),
    over("of NULs", b"\0" * 100, "not YAML"),
    over("UTF-16", "mesh: {edge_length: 1}".encode("utf-16"), "not UTF-8"),
    over("Latin-1", "results: f\xfcr".encode("latin-1"), "not UTF-8"),
    over("a novel", "#" * 3_000_000, "expected at most"),
    over(
        "a hole of a terabyte",
        hole,
        "expected at most",
    ),
    over("an archive", b"PK\x03\x04" + bytes(100), "not UTF-8|not YAML"),
    Malformed(
        "configuration: empty", "check|--no-picture|--config|bad.yaml", "cases is missing", {"bad.yaml": ""}
    ),
    # invalid YAML, or more than a configuration needs
    over("JSON cut off", '{"mesh": {"edge_length": 0.01', "not YAML"),
    over("a tab for indentation", "mesh:\n\tedge_length: 0.01\n", "not YAML"),
    over("a list", "- mesh\n", "holds a list"),
    over("a word", "mesh", "holds a str"),
    over("two documents", "mesh: {}\n---\nmesh: {}\n", "not YAML"),
    over("a key twice", "mesh: {edge_length: 0.01}\nmesh: {tolerance: 0.001}\n", "key mesh .* twice"),
    over(
        "an inner key twice", "mesh:\n  edge_length: 0.01\n  edge_length: 0.02\n", "key edge_length .* twice"
    ),
    over("a Python object", "results: !!python/object/apply:os.system ['touch hacked']\n", "tag"),
    over("a Python name", "results: !!python/name:os.system\n", "tag"),
    over("a Python module", "results: !!python/module:os\n", "tag"),
    over("a tuple of Python", "settings: !!python/tuple [1]\n", "tag"),
    over("an own tag", "results: !secret x\n", "tag"),
    over("a tag that does not fit", "results: !!int x\n", "tag"),
    over("a truth that is none", "results: !!bool perhaps\n", "tag"),
    over("a binary", "results: !!binary aGk=\n", "tag"),
    over("a billion laughs", LAUGHS, "anchor|alias"),
    over("an anchor in itself", "mesh: &m {edge_length: *m}\n", "anchor|alias"),
    over("a merge", "mesh: &m {edge_length: 0.01}\nvirtual_mesh:\n  <<: *m\n", "anchor|alias"),
    over("an unknown alias", "mesh: *nowhere\n", "anchor|alias"),
    over("a hundred thousand brackets", "mesh: " + "[" * 100_000, "not YAML|nested"),
    over("deep and closed", "mesh: " + "[" * 5_000 + "]" * 5_000, "nested"),
    over("the 45th of a 13th month", "results: 2026-13-45\n", "not YAML|2026-13-45"),
    over("a day for a folder", "results: 2026-01-01\n", "results = "),
    over(
        "a number of five thousand digits", f"numerics: {{max_beats: {'9' * 5000}}}\n", "not YAML|max_beats"
    ),
    over("a table as key", "{a: b}: c\n", "not YAML|key"),
    over("a number as key", "1: 2\n", "key 1"),
    over("nothing as key", "~: 2\n", "key None"),
    # keys
    over("a key misspelt", "mseh: {}\n", "unknown key mseh; did you mean mesh"),
    over("an inner key misspelt", "mesh: {edge_lenght: 0.01}\n", "did you mean edge_length"),
    setting("a setting's key misspelt", "elment: p1", "did you mean element"),
    over("a key in capitals", "Mesh: {}\n", "unknown key Mesh"),
    over("a key with a blank", '"mesh ": {}\n', "unknown key mesh"),
    over("a key of another alphabet", "m\u0435sh: {edge_length: 0.01}\n", "unknown key"),
    over("a key of a thousand letters", f"{'k' * 1000}: 1\n", "unknown key"),
    over("a key with a line's end", '"me\\nsh": 1\n', "unknown key"),
    whole("a key left out", "cases: cases.tsv", "", "cases is missing"),
    whole(
        "a table left out",
        "numerics:\n  time_step: 0.005\n  max_beats: 8\n  drift: 0.002",
        "",
        "numerics is missing",
    ),
    # types
    over("text for a number", "mesh: {edge_length: fine}\n", "edge_length = 'fine'"),
    over("a decimal comma", "mesh: {edge_length: '0,008'}\n", "edge_length = '0,008'"),
    over("a unit behind a number", "mesh: {edge_length: 8 mm}\n", "edge_length = '8 mm'"),
    over("a list for a number", "mesh: {edge_length: [0.01]}\n", "edge_length"),
    over("a number for a table", "mesh: 0.01\n", "mesh = 0.01"),
    over("nothing for a table", "mesh:\n", "mesh = None"),
    over("a list for a table", "settings: [locking]\n", "settings"),
    over("a table for a list", "discovery: {trials: {a: b}}\n", "trials"),
    over("text for a list", "discovery: {trials: MitralRegurgitation}\n", "trials"),
    over("a list for a folder", "measured_heart: [heart]\n", "measured_heart"),
    over("a fraction for a count", "numerics: {max_beats: 2.5}\n", "max_beats"),
    over("a truth for a number", "cohort: {heart: {sigma_0: yes}}\n", "sigma_0"),
    over("a truth among numbers", "sphere_study: {noise: {q_min: yes}}\n", "q_min: True says yes or no"),
    over("half a count", "observation: {frames: 25.5}\n", "frames = 25.5"),
    over("an octal number", "sphere_study: {seed: 010}\n", "010, line 1, is read as 8"),
    over("minutes and seconds", "numerics: {time_step: 1:30}\n", "1:30, line 1, is read as 90"),
    over("digits apart", "sphere_study: {seed: 1_0}\n", "1_0, line 1, is read as 10"),
    over("digits apart, as a text", "sphere_study: {seed: '1_0'}\n", "1_0 is no number; expected digits"),
    over("digits apart in a table", "cohort: {heart: {mu: '1_0.0'}}\n", "mu: 1_0.0 is no number"),
    over("a truth for a count", "numerics: {max_beats: true}\n", "max_beats"),
    over("a number for a truth", "unscented: {noise: 7}\n", "noise"),
    # numbers
    over("NaN", "mesh: {edge_length: .nan}\n", "edge_length"),
    over("NaN for a parameter", "cohort: {heart: {sigma_0: .nan}}\n", "sigma_0"),
    over("infinity", "prior: {mu: {mean: .inf}}\n", "mean"),
    over("minus infinity", "end_diastolic_pressure: {lv: -.inf}\n", "lv"),
    over("a negative length", "mesh: {edge_length: -0.008}\n", "edge_length"),
    over("millimetres", "mesh: {edge_length: 8}\n", "edge_length"),
    over("millimetres of mercury", "end_diastolic_pressure: {lv: 10e3}\n", "lv"),
    over("milliseconds", "numerics: {time_step: 5}\n", "time_step"),
    over("no time step", "numerics: {time_step: 0}\n", "time_step"),
    over("no beats", "numerics: {max_beats: 0}\n", "max_beats"),
    over("beats without end", "numerics: {max_beats: 1000000000000}\n", "max_beats"),
    over("frames without end", "observation: {frames: 1000000000}\n", "frames"),
    over("hearts without end", "registration_error: {sequences: 1000000000000}\n", "sequences"),
    over("hidden hearts without end", "discovery_benchmark: {singles: 1000000000000}\n", "singles"),
    over("too few frames", "observation: {frames: 5}\n", "frames"),
    over("a window that is even", "observation: {window: 4}\n", "window"),
    over("a window longer than the beat", "observation: {window: 99}\n", "window"),
    over("an order above the window", "observation: {order: 9}\n", "order"),
    over("samples that are no power of two", "sensitivity: {sphere: {samples: 100}}\n", "power of two"),
    over("a seed that is none", "registration_error: {seed: -1}\n", "seed"),
    # priors and parameters
    over("a negative mean", "prior: {mu: {mean: -1}}\n", "prior.mu.mean"),
    over("a negative deviation", "prior: {mu: {sd: -0.3}}\n", "prior.mu.sd"),
    over("a deviation of percents", "prior: {mu: {sd: 30}}\n", "prior.mu.sd"),
    over("a prior of nothing known", "prior: {muu: {mean: 1}}\n", "muu"),
    over("a parameter with two places", "cohort: {heart: {closed: 1}}\n", "give the path"),
    setting("nothing estimated", "estimate: []", "estimate"),
    setting("a parameter estimated twice", "estimate: [mu, mu]", "twice"),
    setting("estimated and fixed", "estimate: [mu], heart: {mu: 1e3}", "estimated and fixed"),
    setting("a parameter that is none", "estimate: [sigma0]", "sigma_0"),
    setting("a negative parameter", "heart: {alpha: -5}", "alpha"),
    setting(
        "one that may be negative estimated",
        "estimate: [CatheterOffset.offset], mechanisms: [CatheterOffset]",
        "log-normal",
    ),
    # mechanisms and parts
    setting("a mechanism that is none", "mechanisms: [MitralLeak]", "did you mean Mitral"),
    setting("a mechanism twice", "mechanisms: [MitralStenosis, MitralStenosis]", "twice"),
    setting("a path for a mechanism", "mechanisms: [../../os]", "unknown"),
    setting("another element", "element: p2", "element"),
    setting("another reference", "reference: zero", "reference"),
    over("a trial that is none", "discovery: {trials: [AtrialSurgery]}\n", "AtrialSurge"),
    over("a search of no setting", "discovery: {settings: [fysical]}\n", "known settings are"),
    over("a search of no case", "discovery: {cases: [nobody]}\n", "nobody"),
    over("a hidden effect that is none", "discovery_benchmark: {ventricles: {effects: [Ghost]}}\n", "Ghost"),
    over("a question of no setting", "discovery: {element: {setting: fysical}}\n", "fysical"),
    over("a question of no mechanism", "discovery: {element: {mechanism: Ghost}}\n", "Ghost"),
    over(
        "a scanner's knob that is none",
        "registration_error: {varied: {signal_to_nose: [1]}}\n",
        "no setting of the scanner",
    ),
    over("a scanner's value that cannot be", "registration_error: {varied: {frames: [-3]}}\n", "frames"),
    over("a noise that is missing", "sphere_study: {noise: {V_foo: 1}}\n", "noise"),
    over("a sensitivity of no case", "sensitivity: {case: nobody}\n", "nobody"),
    # paths
    over("results outside", "results: ../outside\n", "results.* within"),
    over("results above by a detour", "results: a/../../outside\n", "results.* within"),
    over("results at an absolute place", "results: /tmp/outside\n", "results.* within"),
    over("results at home", "results: ~/outside\n", "results"),
    over("results nowhere", "results: ''\n", "results"),
    over("results here", "results: .\n", "results"),
    over("results with a wildcard", "results: 'a{case}'\n", "results"),
    over("a page outside", "discovery_benchmark: {page: ../..}\n", "page"),
    over("a page of ventricles outside", "discovery_benchmark: {ventricles: {page: /etc}}\n", "page"),
    over("a setting's name that is a path", "settings: {../../x: {element: p1, estimate: [mu]}}\n", "name"),
    over("a setting's name that is a pattern", "settings: {'.*': {element: p1, estimate: [mu]}}\n", "name"),
    over(
        "a setting's name that is a folder's",
        "settings: {geometry: {element: p1, estimate: [mu]}}\n",
        "geometry",
    ),
    over("a setting without a name", "settings: {'': {element: p1, estimate: [mu]}}\n", "name"),
    Malformed(
        "configuration: results behind a link",
        CHECK,
        "results.* within",
        {"bad.yaml": "results: away/results\n", "away": lambda path: path.symlink_to("/tmp")},
    ),
]
