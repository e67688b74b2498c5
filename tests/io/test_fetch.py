"""Fetched files equal the published ones, or do not exist."""

import hashlib

import pytest

from heartfit.core.errors import InputError
from heartfit.io.files import fetch


@pytest.fixture
def published(tmp_path):
    """An address below which one file is published, a manifest of it, and a folder to fetch into."""
    (tmp_path / "there").mkdir()
    (tmp_path / "there" / "source.txt").write_text("control points")
    checksum = hashlib.sha256(b"control points").hexdigest()
    manifest = tmp_path / "manifest.tsv"
    manifest.write_text(f"# origin\nfile\tsource\tsha256\npart/file.txt\tsource.txt\t{checksum}\n")
    return (tmp_path / "there").as_uri() + "/", manifest, tmp_path / "here"


def test_a_published_file_arrives(published):
    address, manifest, folder = published
    fetch(manifest, address, folder)
    assert (folder / "part" / "file.txt").read_text() == "control points"


def test_a_correct_file_is_not_fetched_again(published):
    address, manifest, folder = published
    fetch(manifest, address, folder)
    fetch(manifest, "file:///nowhere/", folder)
    assert (folder / "part" / "file.txt").read_text() == "control points"


def test_a_file_with_another_check_sum_is_refused_and_removed(published, tmp_path):
    address, manifest, folder = published
    (tmp_path / "there" / "source.txt").write_text("something else")
    with pytest.raises(InputError, match="it is not the published file"):
        fetch(manifest, address, folder)
    assert [path for path in folder.rglob("*") if path.is_file()] == []
