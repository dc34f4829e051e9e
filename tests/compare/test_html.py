"""The web page of a comparison: one file that loads nothing, with a row for each difference that leads to its place."""

import base64
import hashlib
import re
import shutil
from dataclasses import replace

import pytest

from hlr.compare import compare
from support.drawings import arc, drawing, line, part

HOSTILE = "</td><script>window.broken = 1</script><img src=x onerror='window.broken = 2'>"
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


def found():
    """A line that is gone, a short one that is new, one that is displaced."""
    same = [line([[0, 0], [100, 0], [100, 60]]), arc((50, 30), 10, 10, (0, 6.28))]
    before = drawing([*same, line([[10, 10], [50, 20]]), line([[20, 50], [60, 50]])], parts=[part(HOSTILE)])
    after = drawing([*same, line([[90, 40], [91, 41]]), line([[20, 50.3], [60, 50.3]])], parts=[part(HOSTILE)])
    return compare(before, after)


def test_the_page_needs_no_other_file_and_names_become_no_markup():
    text = found().to_html()
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', text)[1].replace("&#39;", "'")
    assert policy.startswith("default-src 'none'; ") and "unsafe" not in policy
    for tag in ("style", "script"):
        for content in re.findall(rf"<{tag}>(.*?)</{tag}>", text, re.DOTALL):
            digest = base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()
            assert f"'sha256-{digest}'" in policy
    assert HOSTILE not in text and "&lt;script&gt;window.broken" in text
    assert not re.search(r"(src|href)=\"|url\(|@import|https?://(?!www\.w3\.org)", text)
    assert text == found().to_html()


def test_each_difference_has_a_row_with_its_place_in_the_picture():
    result = found()
    page = result.overlay()
    rows = re.findall(r'<tr class="([a-z-]+)".*?data-x="([\d.]+)" data-y="([\d.]+)"', result.to_html())
    assert [kind for kind, *_ in rows] == ["gone", "new", "moved"]
    for each, (_, x, y) in zip(result.differences, rows, strict=True):
        assert (float(x) + page.corner[0], page.corner[1] - float(y)) == pytest.approx(each.place, abs=1e-3)


def test_verdicts_are_layers_of_lines_and_rows():
    result = found()
    result.findings.differences[0] = replace(result.findings.differences[0], verdict="second right", reason="hidden")
    text = result.to_html()
    assert '<input type="checkbox" checked data-layer="second-right">' in text and "second right: hidden" in text
    assert '<path class="gone second-right"' in text and '<tr class="gone second-right"' in text
    assert '<path class="new"' in text and "first-right" not in text


def test_two_drawings_that_are_the_same_have_a_page_too(tmp_path):
    same = drawing([line([[0, 0], [10, 0]])])
    path = compare(same, same).save(tmp_path / "same.html")
    assert "There are none." in path.read_text("utf-8")


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here: apt-get install chromium")
def test_in_a_browser_layers_are_switched_and_a_row_leads_to_its_place(tmp_path):
    sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    path = found().save(tmp_path / "difference.html")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page(viewport={"width": 1200, "height": 800})
        told = []
        page.on("console", lambda message: told.append(message.text))
        page.on("pageerror", lambda error: told.append(str(error)))
        page.goto(path.as_uri())
        line_of = page.locator("svg path.gone")
        assert line_of.is_visible()
        page.locator('[data-layer^="gone "]').uncheck()
        assert not line_of.is_visible() and not page.locator("tr.gone").is_visible()
        page.locator("tr.new").click()
        place = page.locator("svg path.new").bounding_box()
        stage = page.locator("[data-stage]").bounding_box()
        for side, size in (("x", "width"), ("y", "height")):
            assert place[side] + place[size] / 2 == pytest.approx(stage[side] + stage[size] / 2, abs=3)
        assert place["width"] > 30
        assert page.locator("tr.new").get_attribute("aria-current") == "true"
        assert page.evaluate("window.broken") is None and told == []
        browser.close()
