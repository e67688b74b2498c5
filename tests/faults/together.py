"""Two runs at once."""

import time

from tests.faults.outcome import Outcome, differences, last_words, one_more_call
from tests.faults.tiny import RESULTS, TinyStudy, finish

OTHER = "results/other"


def two_runs(study: TinyStudy, expected: dict[str, str]) -> list[Outcome]:
    """In one folder of results: the second is refused and disturbs nothing."""
    study.put_back()
    study.remove("volunteer1/physical", "tables", "figures")
    first = study.start()
    time.sleep(8.0)
    code, output = study.run()
    ended, _ = finish(first)
    mended = ended == 0 and code != 0 and not differences(study.sums(), expected)
    mended &= one_more_call(study, expected)
    words = last_words(output, "cannot be locked", "locked")
    fault = "two runs at once in one folder of results"
    return [Outcome(fault, f"the first completed, the second ended with {code}: “{words}”", mended)]


def two_folders(study: TinyStudy, expected: dict[str, str]) -> list[Outcome]:
    """In two folders of results of one checkout: both complete."""
    study.put_back()
    study.remove("volunteer1/physical", "tables", "figures")
    first, second = study.start(), study.start(results=OTHER)
    codes = [finish(process)[0] for process in (first, second)]
    other = study.sums(OTHER)
    named = "tables/numbers.csv"  # names the folder
    table = (study.folder / OTHER / named).read_text() if named in other else ""
    same = table.replace(OTHER, RESULTS) == (study.folder / RESULTS / named).read_text()
    mended = codes == [0, 0] and same and not differences(study.sums(), expected)
    mended &= differences(other, expected) == [f"{named}: other bytes"]
    return [
        Outcome(
            "two runs at once in two folders of results", "both completed, with identical results", mended
        )
    ]
