"""The web page of a batch as a reader uses it: in Chromium, opened from disk."""

import shutil
import time
from pathlib import Path

import pytest
from batch.reports import SVG, drawing, page_of, report, source, written

import hlr

DATA = Path(__file__).resolve().parents[1] / "data"
HOSTILE = "</title><script>window.broken = 1</script><img src=x onerror='window.broken = 2'>"
MORE = (
    "<script>window.broken = 3</script><image href='x' onerror='window.broken = 4' onload='window.broken = 5'/>"
    "<g onclick='window.broken = 6'/><foreignObject><iframe xmlns='http://www.w3.org/1999/xhtml' "
    "srcdoc='&lt;script&gt;parent.broken = 7&lt;/script&gt;'/></foreignObject>"
)

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here: apt-get install chromium"),
]


def until(page, condition, argument=None):
    """Wait until something holds. Playwright's own way runs a text within the page, which the page forbids."""
    deadline = time.monotonic() + 20.0
    while not page.evaluate(condition, argument):
        assert time.monotonic() < deadline, condition
        time.sleep(0.02)


@pytest.fixture(scope="module")
def context():
    sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        context = browser.new_context(viewport={"width": 1200, "height": 800})
        context.set_default_timeout(10_000)
        yield context
        browser.close()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A batch with all that a page can show: an assembly, changes, warnings, failures, hostile names."""
    folder = tmp_path_factory.mktemp("batch")
    (folder / "as1.svg").write_bytes(hlr.draw(DATA / "as1-oc-214.stp", view="front").to_svg().encode())
    before = {"state": "changed", "summary": "3 mm gone", "before": "base/a.svg", "overlay": "base/o.svg"}
    (folder / "base").mkdir()
    for name in ("a", "o"):
        (folder / f"base/{name}.svg").write_text(SVG.format(name="bolt", size=40, more=""))
    (folder / "hostile.svg").write_text(SVG.format(name=HOSTILE.replace("<", "&lt;"), size=80, more=MORE))
    written(
        report(
            source("as1.stp", drawing("as1.svg", seconds={"total": 2.0, "source": 1.5, "scene": 0.5})),
            source("bolt.step", drawing("bolt.svg", change=before), drawing("b.svg", "top", "the threads are crowded")),
            source("bad.step", error="bad.step is cut short."),
            source(HOSTILE, drawing("hostile.svg", HOSTILE, HOSTILE)),
            gone=[HOSTILE],
        ),
        folder,
    )
    return folder


@pytest.fixture
def page(context, folder):
    """The page, opened anew; nothing of it may go wrong."""
    page, wrong = context.new_page(), []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.goto((folder / "index.html").as_uri())
    yield page
    assert page.evaluate("window.broken") is None
    page.close()
    assert not wrong


def shown(page):
    return page.locator(".card:not([hidden]) .name").all_text_contents()


def opened(page, name):
    page.locator(".card", has_text=name).first.locator("a").click()
    page.wait_for_selector("[data-viewer][data-ready]")
    return page.locator("[data-viewer]")


def is_drawn(line):
    return line.evaluate("line => { const r = line.getBoundingClientRect(); return r.width + r.height > 0 }")


def scale(page):
    return page.evaluate("new DOMMatrix(getComputedStyle(document.querySelector('.paper')).transform).a")


def test_search_filters_and_order(page):
    assert shown(page) == ["as1.stp", "bolt.step", "bolt.step", "bad.step", HOSTILE]
    page.keyboard.press("/")
    page.keyboard.type("THREADS crow")
    assert shown(page) == ["bolt.step"]
    page.get_by_role("searchbox").fill("nothing of that")
    assert shown(page) == [] and page.get_by_text("Nothing matches.").is_visible()
    page.get_by_role("searchbox").fill("")
    page.get_by_role("radio", name="Failed").check()
    assert shown(page) == ["bad.step"] and page.get_by_role("status").first.inner_text() == "1 of 5 shown"
    page.get_by_role("radio", name="Changed").check()
    assert shown(page) == ["bolt.step"]
    page.get_by_role("radio", name="All").check()
    page.get_by_label("Order").select_option("slowest")
    assert shown(page)[:2] == ["as1.stp", "bad.step"]


def test_a_line_is_named_and_layers_are_switched(page):
    viewer = opened(page, "as1.stp")
    line = page.locator(".paper g.visible path[data-edge]").first
    point = line.evaluate(
        "path => { const p = path.getPointAtLength(path.getTotalLength() / 2).matrixTransform(path.getScreenCTM());"
        "return [p.x, p.y] }"
    )
    page.mouse.move(point[0] + 3, point[1] + 3)  # beside it
    hint = viewer.locator("[data-hint]")
    hint.wait_for(state="visible")
    part, edge, seen = hint.inner_text().split(" · ")
    assert part in viewer.locator("fieldset", has_text="Parts").inner_text().splitlines()
    assert edge.split()[1] == "edge" and seen == "visible"
    assert page.locator(".paper .marked").count() >= 1
    viewer.get_by_label("hidden", exact=True).uncheck()
    hidden = page.locator(".paper g.hidden path").first
    assert not is_drawn(hidden) and is_drawn(line)
    parts = viewer.locator("fieldset", has_text="Parts")
    parts.get_by_label("all").uncheck()
    assert not is_drawn(line)
    parts.get_by_label(part, exact=True).check()
    assert is_drawn(line)
    viewer.get_by_label(edge.split()[0], exact=True).uncheck()
    assert not is_drawn(line)
    assert viewer.locator("dl").last.inner_text().split()[:6] == ["total", "2.000", "s", "source", "1.500", "s"]


def test_zoom_and_pan(page):
    viewer = opened(page, "bolt.step")
    whole = scale(page)
    stage = viewer.locator("[data-stage]").bounding_box()
    point = stage["x"] + 200, stage["y"] + 100
    paper = viewer.locator("[data-paper]")
    page.mouse.move(*point)
    before = paper.bounding_box()
    page.mouse.wheel(0, -500)
    until(page, "old => new DOMMatrix(document.querySelector('.paper').style.transform).a > old", whole)
    after, factor = paper.bounding_box(), scale(page) / whole
    assert after["x"] - point[0] == pytest.approx((before["x"] - point[0]) * factor, abs=1)  # the point stays
    page.mouse.down()
    page.mouse.move(point[0] + 60, point[1] + 30)
    page.mouse.up()
    moved = paper.bounding_box()
    assert (moved["x"] - after["x"], moved["y"] - after["y"]) == pytest.approx((60, 30), abs=1)
    page.keyboard.press("+")
    assert scale(page) == pytest.approx(whole * factor * 1.25, rel=1e-3)
    viewer.get_by_role("button", name="Fit").click()
    assert scale(page) == pytest.approx(whole)


def test_the_keyboard_is_enough(page):
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-viewer][data-ready]")
    title = page.locator("[data-title]")
    assert title.inner_text() == "bolt.step, front"
    page.keyboard.press("ArrowRight")
    until(page, "document.querySelector('[data-title]').textContent === 'bolt.step, top'")
    page.keyboard.press("ArrowRight")
    page.get_by_text("bad.step is cut short.").last.wait_for()
    page.keyboard.press("Escape")
    until(page, "!document.querySelector('[data-viewer]').open")
    # The page moves the focus once the browser has told it that the viewer is closed.
    until(page, "document.activeElement.closest('.card')?.dataset.state === 'failed'")
    # An address leads to a drawing.
    key = page.locator(".card").nth(1).get_attribute("data-key")
    page.goto(page.url.partition("#")[0] + f"#{key}")
    page.wait_for_selector("[data-viewer][data-ready]")
    assert title.inner_text() == "bolt.step, front"


def test_before_and_after(page):
    viewer = opened(page, "bolt.step")
    viewer.get_by_role("button", name="Swipe").click()
    slider = viewer.get_by_role("slider")
    slider.fill("25")
    assert page.locator(".paper .before").evaluate("e => getComputedStyle(e).clipPath") == "inset(0px 75% 0px 0px)"
    assert page.locator(".paper .after").evaluate("e => getComputedStyle(e).clipPath") == "inset(0px 0px 0px 25%)"
    viewer.get_by_role("button", name="Overlay").click()
    assert page.locator(".paper .overlay").is_visible() and not page.locator(".paper svg").is_visible()
    page.keyboard.press("ArrowRight")
    until(page, "document.querySelector('[data-title]').textContent === 'bolt.step, top'")
    assert not viewer.get_by_role("button", name="Swipe").is_visible()


def test_names_are_only_names(page):
    viewer = opened(page, HOSTILE[:20])
    assert viewer.locator("[data-title]").inner_text() == f"{HOSTILE}, {HOSTILE}"
    assert viewer.get_by_role("checkbox", name=HOSTILE).is_visible()
    page.locator(".paper g[onclick]").dispatch_event("click")
    page.wait_for_timeout(200)  # the fixture looks whether a script has run


def test_light_and_dark(page):
    ground = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(ground)
    page.get_by_label("Colours").select_option("dark")
    assert page.evaluate(ground) != light
    page.reload()
    assert page.evaluate(ground) != light  # it is remembered
    page.get_by_label("Colours").select_option("")
    assert page.evaluate(ground) == light


def test_two_thousand_drawings_do_not_stall(context, tmp_path):
    sources = [source(f"part{n}.step", drawing(f"{n}.svg", warning="odd" if n % 2 else None)) for n in range(2000)]
    started = time.process_time()
    address = page_of(report(*sources), tmp_path).as_uri()  # without files of drawings: it is the page that counts
    assert time.process_time() - started < 2.0
    page = context.new_page()
    page.goto(address)
    # Only what is near the window has been loaded.
    assert page.evaluate("performance.getEntriesByType('resource').filter(e => e.name.endsWith('.svg')).length") < 300
    took = page.evaluate(
        "() => { const start = performance.now(); const search = document.querySelector('[data-search]');"
        "search.value = 'part19'; search.dispatchEvent(new Event('input')); document.body.offsetHeight;"
        "return performance.now() - start }"
    )
    assert took < 500 and page.locator(".card:not([hidden])").count() == 111
    page.close()
