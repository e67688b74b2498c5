"""All mutants, by subject."""

from tests.mutations.mutants.calibration import CALIBRATION_MUTANTS
from tests.mutations.mutants.circulation import CIRCULATION_MUTANTS
from tests.mutations.mutants.consistency import CONSISTENCY_MUTANTS
from tests.mutations.mutants.decision import DECISION_MUTANTS
from tests.mutations.mutants.finite_elements import ELEMENT_MUTANTS
from tests.mutations.mutants.geometry import GEOMETRY_MUTANTS
from tests.mutations.mutants.judging import JUDGING_MUTANTS
from tests.mutations.mutants.mechanisms import MECHANISM_MUTANTS
from tests.mutations.mutants.muscle import MUSCLE_MUTANTS
from tests.mutations.mutants.observation import OBSERVATION_MUTANTS
from tests.mutations.mutants.places import PLACE_MUTANTS
from tests.mutations.mutants.planting import PLANTING_MUTANTS
from tests.mutations.mutants.proof import PROOF_MUTANTS
from tests.mutations.mutants.recentring import RECENTRING_MUTANTS
from tests.mutations.mutants.refit import REFIT_MUTANTS
from tests.mutations.mutants.registration import REGISTRATION_MUTANTS
from tests.mutations.mutants.right_ventricle import RIGHT_VENTRICLE_MUTANTS
from tests.mutations.mutants.scoring import SCORING_MUTANTS
from tests.mutations.mutants.search import SEARCH_MUTANTS
from tests.mutations.mutants.sphere import SPHERE_MUTANTS
from tests.mutations.mutants.structure import STRUCTURE_MUTANTS
from tests.mutations.mutants.wall import WALL_MUTANTS
from tests.mutations.mutants.withdrawal import WITHDRAWAL_MUTANTS

MUTANTS = (
    *MUSCLE_MUTANTS,
    *ELEMENT_MUTANTS,
    *SPHERE_MUTANTS,
    *GEOMETRY_MUTANTS,
    *CIRCULATION_MUTANTS,
    *MECHANISM_MUTANTS,
    *CALIBRATION_MUTANTS,
    *SEARCH_MUTANTS,
    *DECISION_MUTANTS,
    *CONSISTENCY_MUTANTS,
    *JUDGING_MUTANTS,
    *STRUCTURE_MUTANTS,
    *PLACE_MUTANTS,
    *RIGHT_VENTRICLE_MUTANTS,
    *WALL_MUTANTS,
    *WITHDRAWAL_MUTANTS,
    *RECENTRING_MUTANTS,
    *REFIT_MUTANTS,
    *PROOF_MUTANTS,
    *OBSERVATION_MUTANTS,
    *REGISTRATION_MUTANTS,
    *PLANTING_MUTANTS,
    *SCORING_MUTANTS,
)
