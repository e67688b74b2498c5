"""What the instruments show of a calibrated beat."""

from pathlib import Path

from heartfit.configuration.setting import Setting
from heartfit.io.beats import read_beat
from heartfit.io.results import read_result
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve


def read_seen(beat: Path, fitted: Path, setting: Setting) -> dict[str, Curve]:
    """Curves of the beat at an estimate through the setting's sensors; none of a failed beat.

    fitted: a posterior or a refit; both say their parameters in the same place.
    """
    sensors = setting.sensors(read_result(Path(fitted))["summary"]["estimate"])
    return beat_curves(read_beat(Path(beat)), sensors)
