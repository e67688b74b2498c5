"""How many cases are split into studies that run on their own."""

from collections.abc import Sequence


def split(cases: Sequence[str], reference: str, size: int) -> list[list[str]]:
    """Names of the cases of each shard: at most `size`, and the reference, which every study of its own needs."""
    others = [case for case in cases if case != reference]
    return [[reference, *others[start : start + size]] for start in range(0, len(others), size)]
