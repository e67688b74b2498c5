"""What the instruments show of a calibrated beat."""

from pathlib import Path

from heartfit.configuration.setting import Setting
from heartfit.io.beats import read_beat
from heartfit.io.results import read_posterior
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve


def read_seen(beat: Path, posterior: Path, setting: Setting) -> dict[str, Curve]:
    """Curves of the beat at the posterior's estimate, through the setting's sensors; none of a failed beat."""
    sensors = setting.sensors(read_posterior(Path(posterior)).estimate.physical())
    return beat_curves(read_beat(Path(beat)), sensors)
