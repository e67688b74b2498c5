"""Arrays in a file: complete, or refused in one line."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.io.files import keep_sums, replacing
from heartfit.io.meshes import read_arrays, read_motion, read_simulated_motion
from heartfit.io.slice_motions import read_slice_motion


@pytest.fixture
def path(tmp_path):
    keep_sums(tmp_path / "results")
    path = tmp_path / "results" / "motion.npz"
    with replacing(path) as draft:
        np.savez_compressed(draft, times=np.arange(9.0), positions=np.ones((9, 4, 3)))
    return path


def elsewhere(path):
    """Copy without a recorded check sum."""
    return path.parents[1] / path.name


def test_round_trip(path):
    assert read_arrays(path, "times")["times"].tolist() == list(range(9))


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda whole: whole[: len(whole) // 2], "not a zip file"),
        (lambda whole: b"", "No data left"),
        (lambda whole: whole.replace(b"times", b"tames"), "times"),
        (lambda whole: b"text", "pickled"),
    ],
)
def test_a_damaged_file_is_refused_with_and_without_its_check_sum(path, spoil, message):
    whole = path.read_bytes()
    path.write_bytes(spoil(whole))
    with pytest.raises(InputError, match=r"motion\.npz: not what was written there"):
        read_arrays(path, "times")
    elsewhere(path).write_bytes(spoil(whole))
    with pytest.raises(InputError, match=message) as refused:
        read_arrays(elsewhere(path), "times")
    assert "\n" not in str(refused.value)


def test_a_changed_byte_is_detected_by_the_check_sum_of_the_format(path):
    whole = bytearray(path.read_bytes())
    whole[whole.find(b"times.npy") + 40] ^= 1  # of its compressed data
    elsewhere(path).write_bytes(whole)
    with pytest.raises(InputError, match="cannot be read"):
        read_arrays(elsewhere(path), "times")


def test_objects_are_not_unpickled(tmp_path):
    np.savez(tmp_path / "a.npz", times=np.array([{}], dtype=object), allow_pickle=True)
    with pytest.raises(InputError, match="cannot be read"):
        read_arrays(tmp_path / "a.npz", "times")


@pytest.mark.parametrize("read", [read_motion, read_slice_motion, read_simulated_motion])
def test_every_reader_refuses_what_is_missing(read, tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read(tmp_path / "none.npz")
