"""`hlr plan` and `hlr draw --explain`."""

import json
from pathlib import Path

import pytest

MODEL = Path(__file__).resolve().parents[1] / "fuzz/corpus/seeds/box.off"


def test_the_plan_of_a_file(hlr_real):
    done = hlr_real("plan", MODEL)
    assert done.code == 0
    rows = {line[:28].strip(): line for line in done.out.splitlines()}
    assert " off " in rows["crossing search"] and "convex" in rows["crossing search"]
    assert " off " in rows["hidden lines"] and "a pictorial view" in rows["hidden lines"]
    assert " on " in rows["smooth edges"] and "a pictorial view" in rows["smooth edges"]
    assert "on" in hlr_real("plan", MODEL, "--hidden").out.partition("hidden lines")[2].splitlines()[0]
    assert (
        "off"
        in hlr_real("plan", MODEL, "--view", "front", "--no-hidden").out.partition("hidden lines")[2].splitlines()[0]
    )


def test_the_plan_for_machines(hlr_real):
    done = hlr_real("plan", MODEL, "--json", "--view", "front", "--view", "top", "--perspective")
    first, second = json.loads(done.out)["plans"]
    assert (first["view"], second["view"]) == ("front", "top")
    divide = next(d for d in first["plan"] if d["effect"] == "perspective divide")
    assert divide["on"] and divide["origin"] == "scene" and divide["reason"]


def test_a_plan_takes_circles_and_styles_as_a_drawing_does(hlr_real):
    done = hlr_real("plan", MODEL, "--circles", "--style", "dark", "--part-colors", "fills", "--dpi", "300")
    rows = {line[:28].strip(): line for line in done.out.splitlines()}
    assert done.code == 0 and all(" on " in rows[name] for name in ("circles of meshes", "fill"))
    done = hlr_real("plan", MODEL, "--style", "darck")
    assert done.code == 2 and "there is no style 'darck'" in done.err


def test_several_views_are_named(hlr_real):
    done = hlr_real("plan", MODEL, "--view", "front", "--view", "top")
    assert done.out.startswith("front\n") and "\n\ntop\n" in done.out


def test_the_plan_of_a_section(hlr_real):
    done = hlr_real("plan", MODEL, "--view", "iso", "--section", "front")
    assert done.code == 0
    iso, front = done.out.split("\n\nfront")
    assert "\nsection " not in iso and "\nsection " in front
    assert "asked for: its plane cuts 1 part" in front and "1 cut parts" in front
    done = hlr_real("plan", MODEL, "--section", "front", "--uncut", "*", "--json")
    ((plan,),) = [[each["plan"] for each in json.loads(done.out)["plans"]]]
    (told,) = [each for each in plan if each["effect"] == "section"]
    assert told["reason"] == "asked for: its plane cuts 0 parts"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--uncut", "bolt"], "--uncut is for --section: leave it out, or say what is cut"),
        (["--section", "front", "--eye", "1,2,3"], "a section is seen in parallel projection: leave out --eye"),
        (["--section", "front@900"], "section front at y = 900 misses the model"),
    ],
)
def test_sections_that_cannot_be_planned(hlr_real, arguments, message):
    done = hlr_real("plan", MODEL, *arguments)
    assert done.code == 2 and done.out == "" and message in done.err and done.err.count("\n") == 1


def test_a_page_of_a_document_has_no_plan(hlr_real):
    done = hlr_real("plan", MODEL.parents[3] / "data/trolley_assembly.FCStd", "--page", "Page")
    assert (done.code, done.err) == (
        2,
        "hlr: Page is no sheet, and pages of a document have no plan: hlr draw draws them.\n",
    )


@pytest.mark.parametrize("model", ["nowhere.step", "."])
def test_refusals(hlr_real, model):
    done = hlr_real("plan", model)
    assert done.code == 2 and done.out == "" and done.err.count("\n") == 1


def test_explained_after_drawing(hlr_real, tmp_path):
    done = hlr_real("draw", MODEL, "-o", tmp_path / "a.svg", "--explain")
    assert done.code == 0 and done.out == ""
    assert "crossing search" in done.err and "the plan itself" in done.err
    summary = hlr_real("draw", MODEL, "-o", tmp_path / "a.svg", "--json")
    (entry,) = json.loads(summary.out)["drawings"]
    assert {d["effect"] for d in entry["plan"]} >= {"crossing search", "hidden lines"}
