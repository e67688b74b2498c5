"""Size of a graph, limited by Snakemake's own time for it."""

import pytest

from heartfit.study.need import OWN_TIME_SHARE, OwnTime, largest_shard

OWN = OwnTime(start=3.0, job=0.01, square=1e-6)


@pytest.mark.parametrize("cpus", [1, 4, 8])
def test_the_largest_graph_stays_below_the_share(cpus):
    size = largest_shard(30.0, 150.0, cpus, OWN)

    def share(subjects):
        return OWN.seconds(30.0 * subjects) / (150.0 * subjects / cpus)

    assert share(size) <= OWN_TIME_SHARE < share(size + 1)


def test_more_cpus_ask_for_smaller_graphs_until_none_is_small_enough():
    sizes = [largest_shard(30.0, 150.0, cpus, OWN) for cpus in (1, 2, 4, 8)]
    assert sizes == sorted(sizes, reverse=True)
    assert largest_shard(30.0, 150.0, 100, OWN) == 0
