"""The diagnosis with the default of the command line: the simulator is not trusted."""

from collections.abc import Collection, Mapping, Sequence

from heartfit import places as heart_places
from heartfit.core.errors import InputError
from heartfit.discovery.inference.decide import DEFAULT_RULES, STRICT_RULES
from heartfit.discovery.sphere_model import diagnose as sphere_diagnosis
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import Structure, learn_from_controls
from heartfit.io.structure import read_residuals
from heartfit.roles import require_registered


def diagnose(
    recording: Recording,
    conditions: Mapping[str, Recording] | None = None,
    *,
    trust_simulator: bool = False,
    controls: Mapping[str, Recording] | None = None,
    places: Sequence[type[heart_places.Place]] | None = None,
    strict: bool = False,
    without: Collection[str] = (),
) -> Diagnosis:
    """Diagnose the mechanisms that a simulation of a recorded heart lacks.

    conditions: recordings of the same heart under another loading, by name, held out from the fit. trust_simulator:
    allow for no difference between this simulator and the source of the recording, which only its own data justify;
    otherwise the difference is that of healthy beats of other simulators, or of healthy ``controls``, at least five by
    name. places: where an unknown effect may act; if None, all places for a trusted simulator, else none, since the
    difference of another source acts somewhere, too. strict: name nothing below a ln Bayes factor of 10 instead of 5.
    without: mechanisms of the library that are not tried.

    Takes half a minute of one core. Raises InputError for an unknown mechanism, for controls of a trusted simulator,
    for a loop of pressure and volume that runs clockwise, and where the nominal heart does not beat.
    """
    if not isinstance(recording, Recording):
        raise InputError(
            f"diagnose: got {type(recording).__name__}; expected a Recording: read it by read_recording(file)"
        )
    if trust_simulator and controls is not None:
        raise InputError(
            "diagnose: controls tell what the simulator leaves of healthy hearts, and it is trusted; expected one of "
            "both: leave one out"
        )
    for name in without:
        _require_mechanism(name)
    return sphere_diagnosis.diagnose(
        recording,
        conditions,
        rules=STRICT_RULES if strict else DEFAULT_RULES,
        structure=None if trust_simulator else _structure(controls),
        places=_standard_places(trust_simulator) if places is None else places,
        left_out=tuple(without),
    )


def _structure(controls: Mapping[str, Recording] | None) -> Structure:
    """Return the structure of the controls or, without them, of healthy hearts of other simulators."""
    return Structure.from_residuals(read_residuals()) if controls is None else learn_from_controls(controls)


def _standard_places(trust_simulator: bool) -> Sequence[type[heart_places.Place]]:
    return heart_places.PLACES if trust_simulator else ()


def _require_mechanism(name: str) -> None:
    try:
        require_registered(name)
    except KeyError as unknown:
        raise InputError(f"without: {unknown.args[0]}") from unknown
