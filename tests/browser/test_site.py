"""The pages of `mnclab site` from a folder, without a network: no fault is told, words are found, the player moves."""

import re

import pytest
from tools.pages import BEGUN

pytest.importorskip("pdoc")

from mnclab.__main__ import main
from mnclab.shell import site as command
from mnclab.shell.handout import lessons

READBACK = re.compile("ReadPixels")  # the browser's word on who reads a pixel to wait


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The folder of a site with one lesson, that of the player."""
    out, one = tmp_path_factory.mktemp("site"), lessons(["10"])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(command, "lessons", lambda: one)
        assert main(["site", "-o", str(out)]) == 0
    return out


@pytest.fixture
def page(browser):
    """A page that has no network; what it tells of faults, or asks of a network, fails the test."""
    faults, context = [], browser.new_context(viewport={"width": 1366, "height": 768}, offline=True)
    context.route(re.compile("^(?!file:)"), lambda route: faults.append(route.request.url) or route.abort())
    page = context.new_page()
    plain = ("log", "info", "timeEnd")
    page.on("console", lambda said: said.type in plain or READBACK.search(said.text) or faults.append(said.text))
    page.on("pageerror", lambda error: faults.append(str(error)))
    yield page
    context.close()
    assert faults == []


def test_the_first_page_leads_to_a_code_by_a_word(built, page):
    page.goto((built / "index.html").as_uri())
    assert page.locator(".found").is_hidden()
    page.locator("#find").fill("deep-hole mnc:")
    (found,) = page.locator(".found a:visible").all()
    found.click()
    assert page.url.endswith("controls/mnc.html#G83")


def test_the_reference_finds_by_itself(built, page):
    page.goto((built / "reference/mnclab/part.html").as_uri())
    page.get_by_role("searchbox").fill("explain")
    page.get_by_text("Run.explain", exact=False).first.wait_for()


def test_tables_are_narrowed_down(built, page):
    page.goto((built / "controls/jnc-t01.html").as_uri())
    assert page.locator("tr#G90").is_visible() and page.locator("section#G73").is_visible()
    page.locator("#find").fill("постоянная скорость")  # the manual's own words, 8.20: G96
    assert page.locator("tr#G96").is_visible()
    assert page.locator("tr#G90").is_hidden() and page.locator("section#G73").is_hidden()
    rows = page.locator("section#G77 tr:has(td)").count()
    page.locator("#find").fill("G77")  # the section of a cycle stays whole
    assert page.locator("section#G77 tr:has(td):visible").count() == rows > 3
    assert page.locator("#none").is_hidden()
    page.locator("#find").fill("zzz")
    assert page.locator("#none").is_visible()


def test_the_player_of_a_lesson_moves(built, page):
    page.goto((built / "lessons/10_player_and_stepping.html").as_uri())
    frame = page.locator("iframe.mnclab-player").first.element_handle().content_frame()
    frame.evaluate(BEGUN)
    assert frame.evaluate("window.player.atStart")
    frame.locator("#play").click()
    page.wait_for_timeout(500)
    assert frame.evaluate("window.player.place.t") > 0.2  # s, at the speed of the machine
    assert page.locator(".mnclab-player-still").first.is_hidden()  # the picture for where no script runs
