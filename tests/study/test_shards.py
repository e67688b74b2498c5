"""Shards: every case in one, the reference case in all."""

from hypothesis import given
from hypothesis import strategies as st

from heartfit.study.forecast import split_cases


@given(st.integers(1, 60), st.integers(0, 59), st.integers(1, 20))
def test_every_case_is_in_one_shard_and_the_reference_in_all(number, at, size):
    cases = [f"heart{n}" for n in range(number)]
    reference = cases[at % number]
    shards = split_cases(cases, reference, size)
    assert all(shard[0] == reference and len(shard) <= size + 1 for shard in shards)
    assert [case for shard in shards for case in shard[1:]] == [case for case in cases if case != reference]
