"""Mutants of the places, of their search and of the laws that their functions follow."""

from tests.mutations.mutant import changes

PLACES = "tests/places/test_places.py"
SEARCH = "tests/discovery/sphere_model/test_place_search.py"
LAWS = "tests/discovery/sphere_model/test_law_ranking.py"
FILE = "tests/results/test_mechanism_file.py"
VERDICT = "tests/discovery/sphere_model/test_unknown_place.py"

PLACE_MUTANTS = (
    *changes(
        "roles/laws.py",
        PLACES,
        ("no flow without a pressure", "return flow + laws[t, k, 5], slope", "return flow, slope"),
    ),
    *changes(
        "heart/muscle/control.py",
        PLACES,
        (
            "no bridge attaches late",
            "attached = attached + self._mean(added",
            "attached = attached + 0.0 * self._mean(added",
        ),
    ),
    *changes(
        "places/periodic.py",
        PLACES,
        ("the integral of a sine is a sine", "((1.0 - np.cos(angle)) / rate)", "(np.sin(angle) / rate)"),
    ),
    *changes(
        "places/cosines.py",
        PLACES,
        ("the slope of a cosine rises", "slopes: Floats = -np.pi", "slopes: Floats = np.pi"),
    ),
    *changes(
        "places/wall.py",
        PLACES,
        ("the slope of a product has one term", "value + u * self.function.slope_at(u)", "value"),
    ),
    *changes(
        "places/region.py",
        PLACES,
        ("a leak is a backflow", '"backflow" if "aorta" in ends else "leak"', '"backflow"'),
    ),
    *changes(
        "discovery/sphere_model/place_search.py",
        SEARCH,
        (
            "a linear model may promise anything",
            "evidences - np.maximum(0.0, promised - PROMISE)",
            "evidences",
        ),
        ("the linear model stands at the fit", "np.zeros(fit.x.size - self.base)", "fit.x[self.base :]"),
        (
            "places stand beside a fit that stopped early",
            "return RankedPlaces(baseline, _ranked(place.beside(gain) for place in places))",
            "return RankedPlaces(self.baseline, _ranked(places))",
        ),
    ),
    *changes(
        "places/wall.py",
        PLACES,
        ("all segments are delayed", "values - values[0]", "values"),
    ),
    *changes(
        "discovery/sphere_model/law_ranking.py",
        LAWS,
        ("shapes cost nothing", "logsumexp(likelihoods) - np.log(likelihoods.size)", "likelihoods.max()"),
        ("the prior of the coefficients is counted", "precision - np.eye(z.shape[1])", "precision"),
        ("a one-sided size is negative", "max(size, 0.0) if law.one_sided else size", "size"),
    ),
    *changes(
        "results/mechanism_file.py",
        FILE,
        ("a written mechanism leaks by conductance", '"area=self.size"', '"conductance=self.size"'),
    ),
    *changes(
        "discovery/sphere_model/unknown_place.py",
        VERDICT,
        ("a place of the named region withdraws the name", "if region not in named and ", "if "),
        (
            "a place needs no held-out gain",
            "if not all(test and test.helps() for test in tests):",
            "if not tests:",
        ),
        (
            "a weaker place withdraws a name",
            "least = max([self.case.rules.detected, *(factors if names else ())])",
            "least = self.case.rules.detected",
        ),
        (
            "a name needs less evidence than a place",
            "near[0].ln_bayes_factor - LEAD):",
            "-near[0].ln_bayes_factor):",
        ),
        (
            "a mechanism is confirmed where nothing acts",
            "if not regions_of(self.case.library[name].kind) & {place.region for place in near}:",
            "if not near:",
        ),
        (
            "all samples choose what predicts the held-out half",
            "choice = max(refits, key=lambda place: place.ln_bayes_factor)",
            "choice = refits[0]",
        ),
        ("far regions are near", "> detected[0].ln_bayes_factor - LEAD", "> -detected[0].ln_bayes_factor"),
    ),
)
