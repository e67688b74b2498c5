"""Detection limits of leaks and stenoses by what was measured: python -m benchmarks.right_ventricle_limits

Of both ventricles' volumes and pressures, in the adult of the search and hearts drawn from its priors. Stores
docs/measured/right_ventricle_limits.tsv. Some minutes.
"""

from benchmarks.measured_table import store_table
from heartfit.discovery.sphere_model.limits import LEFT_CURVES, DetectionLimit, detection_limits
from heartfit.discovery.sphere_model.nominal_heart import ADULT, WITH_RIGHT
from heartfit.results.right_ventricle import right_limits_table

HEARTS = 5
VOLUMES = (*LEFT_CURVES, "rv_volume")
BOTH_SIDES = ("MitralRegurgitation", "AorticRegurgitation", "MitralStenosis", "AorticStenosis")
RIGHT_SIDE = (
    "TricuspidRegurgitation",
    "PulmonaryRegurgitation",
    "TricuspidStenosis",
    "PulmonaryStenosis",
    "LateRightWall",
)


def main() -> None:
    """Compute and store the table."""
    left = {limit.name: limit for limit in detection_limits(HEARTS, ADULT, BOTH_SIDES, curves=LEFT_CURVES)}
    names = (*BOTH_SIDES, *RIGHT_SIDE)
    both, catheter = (
        {limit.name: limit for limit in detection_limits(HEARTS, WITH_RIGHT, names, curves=curves)}
        for curves in (VOLUMES, (*VOLUMES, "rv_pressure"))
    )
    unseen = {name: unseen_limit(limit) for name, limit in both.items()}
    tables = {
        "left volume and pressure": [(unseen | left)[name] for name in names],
        "and right volume": [both[name] for name in names],
        "and right pressure": [catheter[name] for name in names],
    }
    store_table("right_ventricle_limits", right_limits_table(tables), "benchmarks.right_ventricle_limits")


def unseen_limit(limit: DetectionLimit) -> DetectionLimit:
    """Return the limit of an effect of the right side that the left one does not show at any size."""
    return DetectionLimit(limit.name, limit.switch, limit.sign, tuple(0.0 for _ in limit.factors), None)


if __name__ == "__main__":
    main()
