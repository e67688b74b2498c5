"""The shipped reference case of PhysioBlocks: CPU seconds of its run and its last cycle in SI units, as JSON."""

import json
import time
from pathlib import Path

import numpy as np
import physioblocks
from physioblocks.configuration import load, unwrap_aliases
from physioblocks.io.aliases import load_aliases
from physioblocks.io.configuration import read_json
from physioblocks.utils.dynamic_import_utils import import_libraries

ROOT = Path(physioblocks.__file__).parent
BEATS, PER_BEAT = 10, 1001
CURVES = {"volume": "cavity.volume", "pressure": "cavity.blood_pressure"}


def main() -> None:
    import_libraries([ROOT / "library"])
    load_aliases(str(ROOT / "library" / "aliases"))
    case = unwrap_aliases(read_json(str(ROOT / "references" / "spherical_heart_forward_sim.jsonc")))
    case.configuration_items.pop("preprocesses", None)
    case.configuration_items.pop("postprocesses", None)
    simulation = load(case)
    begin = time.process_time()
    beats = simulation.run()["main"]
    used = time.process_time() - begin
    curves = {name: np.asarray(beats[column])[-PER_BEAT:].tolist() for name, column in CURVES.items()}
    print(json.dumps({"cpu_s_a_beat": used / BEATS, **curves}))


if __name__ == "__main__":
    main()
