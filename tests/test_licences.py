"""No dependency of the core is under the GPL or AGPL alone; see docs/decisions/set_up.md."""

import re
from importlib import metadata

STRONG = re.compile(r"\b(A?GPL|GNU (Affero )?General Public License)", re.IGNORECASE)
LIBRARY = re.compile(r"LGPL|Lesser|Library General", re.IGNORECASE)
PERMISSIVE = re.compile(r"\b(MIT|BSD|Apache|PSF|MPL|Public Domain|ISC)\b", re.IGNORECASE)


def core():
    """Names of all distributions that heartfit needs, directly or not, without its development tools."""
    core_names, waiting = set(), {"heartfit"}
    while waiting:
        name = waiting.pop()
        core_names.add(name)
        needs = [text for text in metadata.requires(name) or [] if "extra ==" not in text]
        names = {re.match(r"[\w.-]+", text)[0].lower().replace("_", "-") for text in needs}
        waiting |= {name for name in names - core_names if installed(name)}
    return core_names - {"heartfit"}


def installed(name):
    """False for what this platform or Python does not need."""
    try:
        metadata.distribution(name)
    except metadata.PackageNotFoundError:
        return False
    return True


def licences(name):
    data = metadata.metadata(name)
    classifiers = [text for text in data.get_all("Classifier") or [] if text.startswith("License")]
    return [data.get("License-Expression") or "", (data.get("License") or "").split("\n")[0], *classifiers]


def is_strong(texts):
    """Under the GPL or AGPL with no permissive or weak alternative beside it."""
    strong = any(STRONG.search(text) and not LIBRARY.search(text) for text in texts)
    return strong and not any(PERMISSIVE.search(text) for text in texts)


def test_no_dependency_of_the_core_is_gpl_alone():
    names = core()
    assert {"numpy", "snakemake", "wildmeshing", "scikit-fem"} <= names
    assert [name for name in sorted(names) if is_strong(licences(name))] == []


def test_strong_licences_are_recognised():
    assert is_strong(["GPL-3.0-or-later"])
    assert is_strong(["", "License :: OSI Approved :: GNU Affero General Public License v3"])
    assert not is_strong(["LGPL-3.0"])
    assert not is_strong(["Public Domain", "License :: OSI Approved :: GNU General Public License (GPL)"])
