"""The page: templates filled with what a study found, scripts allowed by their hashes and nothing from the network."""

import base64
import hashlib
import json
from dataclasses import dataclass
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from heartfit.report.cause import CauseCard, cause_card
from heartfit.report.cohort_figure import plot_cohort
from heartfit.report.curves_figure import plot_curves
from heartfit.report.markup import number, quantity, rows
from heartfit.report.observed import facts, observations, status
from heartfit.report.parameters_figure import plot_estimates, plot_parameters
from heartfit.report.picture import Picture
from heartfit.report.record import CaseRecord, Fit, StudyRecord
from heartfit.report.shades import shades
from heartfit.report.surface import viewed
from heartfit.tables.cause_card import sentence
from heartfit.tables.errors_table import mean_error

POLICY = (
    "default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; img-src data: blob:; "
    "base-uri 'none'; form-action 'none'"
)


@dataclass(frozen=True)
class Assets:
    """Texts that go into the page as they are: the viewer library, our own script and the style."""

    library: str
    script: str
    style: str

    def policy(self) -> str:
        """The Content-Security-Policy: these two scripts, no other and no address outside the page."""
        return POLICY.format(scripts=" ".join(map(_allowed, (self.library, self.script))))


def _allowed(script: str) -> str:
    digest = hashlib.sha256(script.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"


@dataclass(frozen=True)
class Section:
    """What the page shows of one case beside its numbers."""

    case: CaseRecord
    curves: Picture
    parameters: Picture
    causes: list[CauseCard]
    viewed: dict[str, Any]


def render(study: StudyRecord, assets: Assets) -> str:
    """The whole page; the same study gives the same text."""
    cases = list(study.cases.values())
    settings = list(cases[0].fits)
    page = _environment().get_template("page.html")
    return page.render(
        assets=assets,
        study=study,
        settings=settings,
        cohort=plot_cohort(cases),
        parameters={setting: plot_parameters(cases, setting) for setting in settings},
        sections=[_section(case, cases) for case in cases],
        shades=shades(cases),
    )


def _section(case: CaseRecord, cases: list[CaseRecord]) -> Section:
    curves = plot_curves(case)
    causes = [card for setting, fit in case.fits.items() for card in _causes(setting, fit)]
    return Section(
        case, curves, plot_estimates(case, cases), causes, viewed(case) | {"follow": curves.follow}
    )


def _causes(setting: str, fit: Fit) -> list[CauseCard]:
    """What was searched and what was proved of a fit, where somebody looked."""
    titles = {"search on the sphere": fit.searched, "refit in three dimensions": fit.proved}
    return [cause_card(found, f"{setting}: {title}") for title, found in titles.items() if found is not None]


def _environment() -> Environment:
    """Everything escaped, a missing name an error."""
    environment = Environment(
        loader=PackageLoader("heartfit.report", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"quantity": quantity, "number": number, "rows": rows, "data": data}
    environment.globals |= {
        "facts": facts,
        "observations": observations,
        "status": status,
        "sentence": sentence,
        "mean_error": mean_error,
    }
    return environment


def data(content: Any) -> Markup:
    """JSON that stands in a page: no text of it can end the element."""
    text = json.dumps(content, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029"))
