"""What to measure next, in words."""

from heartfit.diagnosis.cause import Verdict
from heartfit.diagnosis.recording import Recording

PRESSURE = "the left ventricular pressure over a beat: with the volume alone one in nine effects is found"
LOADING = (
    "the same curves under another loading, as legs raised: it tells mechanisms apart that look alike at rest"
)


def next_measurement(verdict: Verdict, recording: Recording) -> str:
    """The cheapest measurement that is expected to decide; empty where nothing is open."""
    if "lv_pressure" not in recording.curves:
        return PRESSURE
    return LOADING if verdict in ("group", "unknown") else ""
