"""Places: slots of the heart's equations, or of its measurement, in which a free function may act.

A discrepancy added to the curves says that something is missing; a function inside the equations says where,
conserves blood, and can be carried to another state of the same heart. A place is a mechanism of one role with such a
function instead of a law: of time, or of the slot's own state. Source: latent force models, Alvarez, Luengo and
Lawrence 2013, doi:10.1109/TPAMI.2013.86.
"""

from heartfit.places.library import EARLIER_PLACES, PLACES
from heartfit.places.place import REGIONS, Place, Region
from heartfit.places.region import regions_of

__all__ = ["EARLIER_PLACES", "PLACES", "REGIONS", "Place", "Region", "regions_of"]
