"""The diagnosis of the example among all mechanisms, with the steps of the command."""

import pytest

from tests.examples.pages import assert_shown


@pytest.mark.long
def test_the_page_states_what_the_diagnosis_prints(run):
    assert_shown("diagnose.py", run("diagnose.py"))
