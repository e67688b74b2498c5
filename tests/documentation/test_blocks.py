"""Every block of code of the pages is run, here or where the page says, or the page says why it is not."""

import re

import pytest

from tests.documentation.blocks import ROOT, Block, blocks_of, carry_out, pages_of

PAGES = [ROOT / "README.md", *pages_of("docs"), *pages_of("studies")]
RUN = [page for page in PAGES if any(block.run_here for block in blocks_of(page))]
"""These take some minutes together."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_block_not_run_here_names_the_test_that_runs_it_or_a_reason(page):
    for block in blocks_of(page):
        assert not block.silent, f"console, or a comment above: {block.code}"
        if block.remark:
            elsewhere = re.fullmatch(r"<!-- run by ([\w./]+) -->", block.remark)
            assert elsewhere or re.fullmatch(r"<!-- not run: .+ -->", block.remark), block.remark
            assert not elsewhere or (ROOT / elsewhere[1]).exists(), block.remark


@pytest.mark.long
@pytest.mark.parametrize("page", RUN, ids=lambda page: page.name)
def test_blocks_run(page, tmp_path):
    carry_out(page, tmp_path)


def page_of(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    return page


def test_a_block_that_fails_is_noticed(tmp_path):
    with pytest.raises(AssertionError, match="no_such_name"):
        carry_out(page_of(tmp_path, "```python\nno_such_name\n```\n"), tmp_path)
    with pytest.raises(AssertionError, match="exit 3"):
        carry_out(page_of(tmp_path, "```console\n$ exit 3\n```\n"), tmp_path)


def test_changed_words_are_detected_and_changed_numbers_are_not(tmp_path):
    carry_out(page_of(tmp_path, "```console\n$ echo 4.2 kPa\n4.4 kPa\n$ echo x\nx\n```\n"), tmp_path)
    with pytest.raises(AssertionError, match=r"echo 4\.2 kPa: prints"):
        carry_out(page_of(tmp_path, "```console\n$ echo 4.2 kPa\n4.2 mmHg\n```\n"), tmp_path)


def test_a_comment_above_belongs_to_its_block(tmp_path):
    text = "<!-- not run: hours -->\n```console\n$ sleep 9\n```\n\n```yaml\na: b\n```\n\n```\nheartfit check\n```\n"
    asleep, configured, checked = blocks_of(page_of(tmp_path, text))
    assert asleep == Block("console", "$ sleep 9\n", "<!-- not run: hours -->")
    assert not asleep.run_here
    assert not configured.run_here
    assert not configured.silent
    assert checked.silent


def test_a_page_may_be_run_elsewhere_and_a_command_without_its_sign_is_noticed(tmp_path):
    text = "```console\nheartfit check\n```\n"
    (alone,) = blocks_of(page_of(tmp_path, text))
    (led,) = blocks_of(page_of(tmp_path, f"<!-- every block is run by tests/a.py -->\n\n{text}"))
    assert alone.silent
    assert (led.silent, led.run_here, led.remark) == (False, False, "<!-- run by tests/a.py -->")
