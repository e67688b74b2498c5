"""Malformed recordings."""

import gzip

from tests.malformed.case import Content, Malformed, folder, pipe
from tests.malformed.pictures import pressure
from tests.malformed.sound import recording

SOUND = recording()
DIAGNOSE = "diagnose|bad.csv"
ROW = next(line for line in SOUND.splitlines(keepends=True) if line.startswith("0.0900,"))
CLOCKWISE = recording(lead=-1 / 6)
VOLUME: dict[str, Content] = {
    "volume.csv": "".join(f"{line.rpartition(',')[0] or line}\n" for line in SOUND.splitlines())
}


def curves(name: str, text: Content, message: str) -> Malformed:
    return Malformed(f"recording: {name}", DIAGNOSE, message, {"bad.csv": text})


def with_(name: str, old: str, new: str, message: str) -> Malformed:
    assert old in SOUND, old
    return curves(name, SOUND.replace(old, new, 1), message)


def refused(name: str, command: str, message: str, **files: Content) -> Malformed:
    return Malformed(f"recording: {name}", command, message, files)


def scaled(column: int, factor: float) -> str:
    """A sound table with the numbers of a column multiplied."""
    head, body = SOUND.splitlines()[:2], SOUND.splitlines()[2:]
    rows = [line.split(",") for line in body]
    for row in rows:
        row[column] = f"{factor * float(row[column]):.6g}"
    return "\n".join([*head, *map(",".join, rows)]) + "\n"


MALFORMED = [
    curves("missing", lambda path: None, "no such file"),
    curves("a folder", folder, "is a folder"),
    curves("a device", lambda path: path.symlink_to("/dev/zero"), "not a regular file"),
    curves("a pipe that nobody fills", pipe, "not a regular file"),
    curves("empty", "", "empty"),
    curves("a mark of the byte order and nothing", b"\xef\xbb\xbf", "empty"),
    curves("a header alone", "# period_s = 0.9\ntime_s,lv_volume_ml\n", "0 samples|no rows"),
    curves("comments alone", "# period_s = 0.9\n# nothing\n", "empty"),
    curves("Latin-1", ("# gem\xe4\xdf Ger\xe4t\n" + SOUND).encode("latin-1"), "not UTF-8"),
    curves("UTF-16", SOUND.encode("utf-16"), "not UTF-8"),
    curves("NULs", SOUND.replace("110", "1\x0010", 1) + "\0\0", "bad.csv"),
    curves("an image", b"\x89PNG\r\n\x1a\n" + bytes(100), "not UTF-8"),
    refused(
        "compressed",
        "diagnose|bad.csv.gz",
        "not UTF-8",
        **{"bad.csv.gz": gzip.compress(SOUND.encode())},
    ),
    curves("decimal commas between commas", SOUND.replace(".", ","), "cells"),
    curves(
        "decimal commas and points", SOUND.replace(",", ";").replace(".", ",", 90), "expected a finite number"
    ),
    curves("blanks between columns", SOUND.replace(",", " "), "no column time_s"),
    with_("a row too long", ROW, ROW.replace("\n", ",7\n"), "4 cells, expected 3"),
    with_("a row too short", ROW, "0.0900,142.361\n", "2 cells, expected 3"),
    curves(
        "every row too long",
        SOUND.replace("\n", ",1\n").replace("kpa,1", "kpa").replace("0.9,1", "0.9"),
        "4 cells, expected 3",
    ),
    with_("a quotation mark that is left open", ROW, '"' + ROW, "bad.csv"),
    with_("a word", "142.361", "much", "lv_volume_ml .* is much"),
    with_("NaN", "142.361", "nan", "is nan"),
    with_("infinity", "142.361", "inf", "is inf"),
    with_("a number beyond all", "142.361", "1e999", "is 1e999"),
    with_("a hexadecimal number", "142.361", "0x8e", "is 0x8e"),
    with_("digits with underscores", "142.361", "14_2.361", "is 14_2.361"),
    with_("digits of another alphabet", "142.361", "\u0661\u0664\u0662", "lv_volume_ml"),
    with_("a formula", "142.361", "=1+1", "is =1"),
    with_("a time that is empty", "0.0900,", ",", "time_s .* empty"),
    with_("a time twice", "0.0900,", "0.0600,", "increasing"),
    with_("times that go back", "0.0900,", "0.0100,", "increasing"),
    with_("a column twice", "lv_pressure_kpa", "lv_volume_ml", "column lv_volume_ml .* twice"),
    with_("a column without a name", "lv_pressure_kpa", "", "no name"),
    with_("a column without a unit", "lv_volume_ml", "lv_volume", "did you mean lv_volume_ml"),
    with_("a column misspelt", "lv_volume_ml", "lv_volme_ml", "did you mean lv_volume_ml"),
    with_("an unknown unit", "lv_volume_ml", "lv_volume_pints", "did you mean lv_volume_ml"),
    with_("seconds called milliseconds", "time_s", "time_ms", "record a whole beat"),
    with_("minutes", "time_s", "time_min", "no column time_s"),
    with_("two columns of times", "lv_pressure_kpa", "time_ms", "time_s and time_ms"),
    with_(
        "a curve in two units", "time_s,lv_volume_ml", "time_s,lv_pressure_mmhg", "lv_pressure in two columns"
    ),
    with_("no volume", "lv_volume_ml", "aortic_pressure_kpa", "no lv_volume|pressure"),
    with_(
        "columns swapped",
        "time_s,lv_volume_ml,lv_pressure_kpa",
        "time_s,lv_pressure_kpa,lv_volume_ml",
        "pressure|volume",
    ),
    with_("time and volume swapped", "time_s,lv_volume_ml", "lv_volume_ml,time_s", "time|volume"),
    with_("a flow, which is not searched", "lv_pressure_kpa", "aortic_flow_ml_per_s", "not searched"),
    with_("a period that is no number", "= 0.9", "= 1e", "period"),
    with_("a period of dots", "= 0.9", "= 0.9.9", "period"),
    with_("a period in milliseconds", "= 0.9", "= 900", "period"),
    with_("a period of nothing", "= 0.9", "= 0", "period"),
    with_("a negative period", "= 0.9", "= -0.9", "period"),
    with_("a period of another unit", "period_s = 0.9", "period_ms = 900", "no period"),
    with_("two periods", "# period_s = 0.9\n", "# period_s = 0.9\n# period_s = 0.8\n", "period"),
    with_("a beat that is longer than what was recorded", "= 0.9", "= 2.4", "whole beat"),
    curves("no period", SOUND.replace("# period_s = 0.9\n", ""), "no period"),
    curves("milliseconds", scaled(0, 1e3), "milliseconds"),
    curves("litres", scaled(1, 1e-3), "L taken for mL"),
    curves("negative volumes", scaled(1, -1.0), "volume"),
    curves("volumes of a whale", scaled(1, 50.0), "volume"),
    curves(
        "a volume that does not beat", scaled(1, 0.0).replace(",0,", ",100,"), "expected a curve that beats"
    ),
    curves("millimetres of mercury", scaled(2, 7.5), "mmHg taken for kPa"),
    curves("pascals", scaled(2, 1e3), "pressure"),
    curves("pressures of nothing", scaled(2, 1e-9), "pressure"),
    curves("five samples", recording(rows=5), "at least 8"),
    curves(
        "a volume with one number",
        "# period_s = 0.9\ntime_s,lv_volume_ml,lv_pressure_kpa\n"
        + "".join(f"{0.03 * k},{100 if k == 3 else ''},{k}\n" for k in range(30)),
        "lv_volume",
    ),
    refused("a period that is not one", "diagnose|sound.csv|--rr|nan", "period"),
    refused("a period of nothing given", "diagnose|sound.csv|--rr|0", "period"),
    refused("a period of minutes", "diagnose|sound.csv|--rr|70", "period"),
    refused("a period that is a word", "diagnose|sound.csv|--rr|fast", "--rr"),
    refused(
        "a pressure in both files",
        "diagnose|sound.csv|--pressure|p.csv|--trigger|marker",
        "expected it in one",
        **{"p.csv": pressure(step=0.9 / 160)},
    ),
    refused(
        "a pressure that is missing",
        "diagnose|volume.csv|--pressure|none.csv",
        "none.csv: no such file",
        **VOLUME,
    ),
    refused(
        "a pressure of another rate",
        "diagnose|volume.csv|--pressure|fast.csv|--upstroke|0.08",
        "at the heart rate of the images",
        **VOLUME,
        **{"fast.csv": pressure(step=0.0065)},
    ),
    refused("a unit of pressure alone", "diagnose|sound.csv|--pressure-unit|kPa", "file"),
    refused(
        "a loop that runs clockwise", "diagnose|clockwise.csv", "clockwise", **{"clockwise.csv": CLOCKWISE}
    ),
    refused("an earlier recording that is missing", "diagnose|sound.csv|--against|none.csv", "none.csv"),
    refused(
        "an earlier recording and a group", "diagnose|sound.csv|--against|a.csv|--reference|b", "not allowed"
    ),
    refused(
        "an earlier recording and a condition",
        "diagnose|sound.csv|--against|sound.csv|--condition|legs=sound.csv",
        "without --condition",
    ),
    refused("a group that is a file", "diagnose|sound.csv|--reference|sound.csv", "at least 5"),
    refused("a condition without a name", "diagnose|sound.csv|--condition|sound.csv", "NAME=CSV"),
    refused(
        "a condition that is missing",
        "diagnose|sound.csv|--condition|legs=none.csv",
        "none.csv: no such file",
    ),
    refused("a condition twice", "diagnose|sound.csv|--condition|a=sound.csv|a=sound.csv", "differ"),
    refused("a condition that is a folder", "diagnose|sound.csv|--condition|legs=heart", "is a folder"),
    refused("a result where a file is", "diagnose|sound.csv|-o|sound.yaml", "sound.yaml"),
    refused("a result below a file", "diagnose|sound.csv|-o|sound.yaml/cause", "sound.yaml"),
    refused("a name with a line's end", "diagnose|no\nwhere.csv", "no such file"),
    refused("a name of a thousand letters", f"diagnose|{'x' * 300}.csv", "too long|no such file"),
    refused("a name with a NUL", "diagnose|x\0.csv", "no such file|NUL|null"),
    refused("a name with half a character", "diagnose|x\udcff.csv", "no such file"),
    refused("no file", "diagnose", "required"),
    refused("an option that is none", "diagnose|sound.csv|--fast", "--fast"),
    refused("a command that is none", "diagnoze|sound.csv", "diagnoze"),
    refused("no command", "", "command"),
]
