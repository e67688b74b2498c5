"""Sound input with one random mistake is refused in clear lines."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.malformed.case import exit_code, files_in
from tests.malformed.grammar import RECORDINGS, TABLES_OF_CASES, of_another_kind, of_another_name
from tests.malformed.test_malformed import LONGEST

CHECK = "check|--no-picture|--config|sound.yaml"
FEW_EXAMPLES, MANY_EXAMPLES = 3, 20
PARTS = ("heart/template/subdivision_matrix_sparse.mat", "cine.nrrd", "cine.nii.gz", "cine.mha")
Refused = Callable[[str], list[str]]


def examples(wanted: int) -> Callable[..., object]:
    quiet = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
    return settings(
        max_examples=wanted, derandomize=True, database=None, deadline=None, suppress_health_check=quiet
    )


@pytest.fixture
def refused(here: Path, capsys: pytest.CaptureFixture[str]) -> Refused:
    """The lines in which a command refuses."""

    def run(command: str) -> list[str]:
        before = files_in(here)
        assert exit_code(command) == 2
        lines = capsys.readouterr().err.splitlines()
        assert lines
        assert all(line.startswith("heartfit: ") and len(line) < LONGEST for line in lines)
        assert files_in(here) == before
        return lines

    return run


def numbers_of_examples(wanted: int) -> Iterator[object]:
    """Few examples by default, many with the marker long."""
    return pytest.param(FEW_EXAMPLES, id="few"), pytest.param(wanted, id="many", marks=pytest.mark.long)


@pytest.mark.parametrize("wanted", numbers_of_examples(3 * MANY_EXAMPLES))
@pytest.mark.parametrize("spoilt", [of_another_kind(), of_another_name()], ids=["kind", "name"])
def test_a_configuration_with_another_type_or_key_is_refused(
    wanted: int, spoilt: st.SearchStrategy[tuple[str, str]], here: Path, refused: Refused
) -> None:
    @examples(wanted)
    @given(spoilt)
    def check(content: tuple[str, str]) -> None:
        key, text = content
        (here / "bad.yaml").write_text(text)
        assert any(key in line for line in refused(f"{CHECK}|bad.yaml"))

    (here / "bad.yaml").touch()
    check()


@pytest.mark.parametrize("wanted", numbers_of_examples(2 * MANY_EXAMPLES))
def test_a_random_table_of_cases_is_refused(wanted: int, here: Path, refused: Refused) -> None:
    @examples(wanted)
    @given(TABLES_OF_CASES)
    def check(text: str) -> None:
        (here / "cases.tsv").write_text(text)
        assert any("cases.tsv" in line for line in refused(CHECK))

    check()


@pytest.mark.parametrize("wanted", numbers_of_examples(2 * MANY_EXAMPLES))
def test_a_random_recording_is_refused_in_one_line(wanted: int, here: Path, refused: Refused) -> None:
    @examples(wanted)
    @given(RECORDINGS)
    def check(text: str) -> None:
        (here / "bad.csv").write_text(text)
        (line,) = refused("diagnose|bad.csv")
        assert "bad.csv" in line

    (here / "bad.csv").touch()
    check()


@pytest.mark.parametrize("wanted", numbers_of_examples(MANY_EXAMPLES // 2))
@pytest.mark.parametrize("name", ["sound.vtu", *PARTS])
def test_a_truncated_binary_file_is_refused(wanted: int, name: str, here: Path, refused: Refused) -> None:
    whole = (here / name).read_bytes()

    @examples(wanted)
    @given(st.floats(0.0, 0.95))
    def check(share: float) -> None:
        (here / name).write_bytes(whole[: int(share * len(whole))])
        command = f"simulate|{name}|--config|sound.yaml" if name == "sound.vtu" else f"{CHECK}|bad.yaml"
        assert any(Path(name).name in line for line in refused(command))

    images = f", images: {name}" if name.startswith("cine") else ""
    (here / "bad.yaml").write_text(f"sources: {{mine: {{fit: heart{images}}}}}\n")
    check()


@pytest.mark.long
@pytest.mark.parametrize("name", PARTS)
def test_a_binary_file_with_bytes_turned_over_is_refused_or_read(
    name: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = (here / name).read_bytes()

    @examples(MANY_EXAMPLES // 2)
    @given(st.lists(st.tuples(st.floats(0.0, 0.999), st.integers(1, 255)), min_size=1, max_size=20))
    def check(changes: list[tuple[float, int]]) -> None:
        content = bytearray(whole)
        for share, change in changes:
            content[int(share * len(content))] ^= change
        (here / name).write_bytes(content)
        code, errors = exit_code(f"{CHECK}|bad.yaml"), capsys.readouterr().err
        assert code in (0, 2)
        assert all(line.startswith("heartfit: ") for line in errors.splitlines())
        assert bool(errors) == (code == 2)

    images = f", images: {name}" if name.startswith("cine") else ""
    (here / "bad.yaml").write_text(f"sources: {{mine: {{fit: heart{images}}}}}\n")
    check()
