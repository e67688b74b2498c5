"""The page: whole, closed against the network and against what users write, the same for the same results."""

import json
import re
from html.parser import HTMLParser

import pytest
from tests.report.conftest import ASSETS, HOSTILE
from tests.report.small_report import study

from heartfit.geometry.mesh import VentricularMesh
from heartfit.report.page import Assets, data, render

EMPTY = {"meta", "link", "img", "input", "br"}


class Outline(HTMLParser):
    """Tags that were left open, identities, where links lead and what images say."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.images: list[dict[str, str | None]] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        self.open += [] if tag in EMPTY else [tag]
        self.ids += [given["id"]] if "id" in given else []
        self.links += [given["href"]] if "href" in given else []
        self.images += [given] if tag == "img" else []

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_every_tag_is_closed_every_link_leads_somewhere_and_every_picture_is_told(page: str) -> None:
    outline = Outline(page)
    assert not outline.open
    assert len(outline.ids) == len(set(outline.ids))
    assert {link.removeprefix("#") for link in outline.links} <= set(outline.ids)
    assert len(outline.images) == 1 + 1 + 2 * (1 + 1) + 2, "cohort, setting, each case, both cause cards"
    assert all(
        each["alt"] and each["src"].startswith("data:image/svg+xml;base64,") for each in outline.images
    )


def test_nothing_is_asked_of_the_network(page: str) -> None:
    assert not re.findall(r"""(?:src|href|action|url\()\s*=?\s*["']?(?:https?:)?//""", page)
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]
    assert policy.startswith("default-src &#39;none&#39;; script-src &#39;sha256-")
    assert "unsafe-eval" not in policy
    assert "unsafe-inline" not in policy.split("style-src")[0]


def test_the_policy_allows_these_scripts_and_no_other() -> None:
    changed = Assets(ASSETS.library, ASSETS.script + " ", ASSETS.style)
    assert ASSETS.policy().count("sha256-") == 2
    assert ASSETS.policy() != changed.policy()
    # printf 'const own = 2;' | openssl dgst -sha256 -binary | base64
    assert "'sha256-qKD34zzMFQMgxpImU8FoElsnsqzHWe+offuas9Vn+Uo='" in ASSETS.policy()


def test_what_users_write_stays_text(page: str) -> None:
    assert "<img src=x" not in page
    assert page.count("&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;&amp;") == 2, "below title and table"
    assert json.loads(str(data([HOSTILE]))) == [HOSTILE]
    assert not {"<", "\u2028"} & set(str(data([HOSTILE])))


def test_the_same_results_give_the_same_bytes(ventricle: VentricularMesh, page: str) -> None:
    assert render(study(ventricle, note=HOSTILE), ASSETS) == page


@pytest.mark.parametrize(
    "said",
    [
        "calibrated beat failed",
        "No pressure was recorded",
        "Nobody searched this case",
        "The simulation lacks mitral regurgitation of 0.3 cm²",
        "refit in three dimensions",
        "left bundle branch block",
    ],
)
def test_what_is_missing_and_what_was_found_is_said(page: str, said: str) -> None:
    assert said in page
