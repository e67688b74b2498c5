"""Malformed tables of cases."""

from tests.malformed.case import Content, Malformed, folder
from tests.malformed.sound import CASES

CHECK = "check|--no-picture|--config|sound.yaml"


def table(name: str, text: Content, message: str) -> Malformed:
    return Malformed(f"table of cases: {name}", CHECK, message, {"cases.tsv": text})


def with_(name: str, old: str, new: str, message: str) -> Malformed:
    """The sound table with a part replaced."""
    assert old in CASES, old
    return table(name, CASES.replace(old, new, 1), message)


def filled(name: str, column: str, pressure: str) -> Malformed:
    """Table with a filling pressure of the virtual heart in the given column."""
    row = CASES.replace("5\thealthy\t\t\t", f"5\thealthy\t\t{pressure}\t")
    return table(name, row.replace("\tcatheter", f"\t{column}"), "edp")


MALFORMED = [
    table("empty", "", "empty; expected a table of cases"),
    table("no rows", CASES.splitlines()[0] + "\n", "no case"),
    table("a folder", folder, "is a folder"),
    table("Latin-1", CASES.replace("mine", "m\xfcller").encode("latin-1"), "not UTF-8"),
    table("UTF-16", CASES.encode("utf-16"), "not UTF-8"),
    table("commas", CASES.replace("\t", ","), "no tabs between columns"),
    table("a quotation mark that is left open", CASES.replace("mine", '"mine'), "cases.tsv"),
    table("NULs", CASES.replace("mine", "mi\0ne"), "cases.tsv"),
    table("a cell of a megabyte", CASES.replace("mine", "m" * 1_000_000), "cases.tsv"),
    with_("a cell too many", "0.88\t5", "0.88\t5\t5", "17 cells, expected 16"),
    with_("a cell too few", "158\t3.5", "158", "15 cells, expected 16"),
    with_("a column twice", "mu\tc_1", "mu\tmu", "column mu .* twice"),
    with_("a column without a name", "mu\tc_1", "mu\t", "no name"),
    with_("a column misspelt", "sphericity", "spericity", "did you mean sphericity"),
    with_("a period without unit", "period_s", "period", "period_s"),
    with_("a volume without unit", "\tedv_ml", "\tedv", "edv_ml"),
    with_("a length in inches", "\twall_thickness_mm", "\twall_thickness_in", "wall_thickness"),
    with_("a length in millilitres", "\twall_thickness_mm", "\twall_thickness_ml", "wall_thickness_mm"),
    with_("a ratio in millimetres", "\tsphericity", "\tsphericity_mm", "sphericity"),
    with_("milliseconds for seconds", "0.88", "880", "period"),
    with_("no period", "0.88", "0", "period"),
    with_("a negative period", "0.88", "-0.88", "period"),
    with_("a period that is no number", "0.88", "nan", "period"),
    with_("an endless period", "0.88", "inf", "period"),
    with_("an empty period", "0.88", "", "period is missing"),
    with_("a decimal comma", "0.88", "0,88", "period = '0,88': input should be a valid number"),
    with_("a unit in a cell", "150", "150 ml", "edv = '150 ml': input should be a valid number"),
    with_("digits with underscores", "150", "1_50", "edv: 1_50 is no number"),
    with_("a negative volume", "150", "-150", "edv"),
    with_("litres for millilitres", "150", "0.15", "edv"),
    filled("a filling pressure without unit", "edp", "12"),
    filled("mmHg for kPa", "edp_kpa", "12"),
    filled("kPa for Pa", "edp_pa", "1.6"),
    filled("a filling pressure below none", "edp_mmhg", "-3"),
    with_("a wall of metres", "8.2", "8200", "wall_thickness"),
    with_("a heart that is no length", "1.78", "0", "sphericity"),
    with_("a factor of zero", "1\t1\t1\t1\n", "0\t1\t1\t1\n", "sigma_0"),
    with_("a factor that is huge", "1\t1\t1\t1\n", "1e300\t1\t1\t1\n", "sigma_0"),
    with_("a seed of letters", "0.88\t5", "0.88\tfive", "seed"),
    with_("a negative seed", "0.88\t5", "0.88\t-5", "seed"),
    with_("a kind that is none", "virtual", "imaginary", "kind"),
    with_("a conduction that is none", "5\thealthy", "5\tsick", "conduction"),
    with_("a block without its duration", "5\thealthy", "5\tlbbb", "qrs"),
    with_("two cases of one name", "mine", "volunteer5", "two rows"),
    with_("no name", "mine", "", "case is missing"),
    with_("a name with a slash", "mine", "../mine", "case"),
    with_("a name with a blank", "mine", "my heart", "case"),
    with_("a name with a wildcard", "mine", "{case}", "case"),
    with_("a name that begins with a dash", "mine", "-rf", "case"),
    with_("a name of another alphabet", "mine", "\u5fc3\u81d3", "case"),
    with_("a name of a thousand letters", "mine", "m" * 1000, "case"),
    with_("a name that is a folder's", "mine", "tables", "tables"),
    with_("a virtual heart without its shape", "150\t8.2", "\t8.2", "lacks edv"),
    with_(
        "a period that the measured heart has not",
        "mine\tmeasured\t0.8",
        "mine\tmeasured\t0.9",
        "expected the same to 2 %",
    ),
    Malformed(
        "table of cases: missing",
        f"{CHECK}|bad.yaml",
        "none.tsv: no such file",
        {"bad.yaml": "cases: none.tsv\n"},
    ),
]
