"""A stored search of a wall is read back as it was; a broken one is refused."""

from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.io.walls import read_wall, write_wall
from heartfit.mechanisms.scar import Scar
from heartfit.results.wall_card import render_wall
from tests.discovery.wall_model.test_search import searched


def test_a_summary_is_read_as_written(tmp_path: Path) -> None:
    rendered = render_wall(searched(Scar(extent=0.24, angle=1.05), 11), "The wall")
    write_wall(tmp_path, rendered, "code")
    assert read_wall(tmp_path) == rendered.summary
    assert (tmp_path / "wall.md").read_text().startswith("# The wall")
    assert (tmp_path / "wall.png").stat().st_size > 10_000


def test_a_broken_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "wall.json").write_text("{}")
    with pytest.raises(InputError, match=r"wall\.json"):
        read_wall(tmp_path)
