"""Every example runs, draws something, and leaves beside itself the files that the gallery page shows."""

import re
import runpy
import shutil
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
SCRIPTS = sorted(EXAMPLES.glob("[0-9]*.py"))
OPTIONAL = ("build123d",)
PART = re.compile(rb"<part index=")
VISIBLE = re.compile(rb'<g id="visible".*</svg>', re.DOTALL)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A copy of the examples' scripts and models, without anything that they have written."""
    copy = tmp_path_factory.mktemp("examples")
    for path in EXAMPLES.glob("*.py"):
        shutil.copy(path, copy)
    shutil.copytree(EXAMPLES / "models", copy / "models")
    return copy


def paths(svg):
    found = VISIBLE.search(svg)
    return found.group().count(b"<path ") if found else 0


def test_there_are_examples():
    assert len(SCRIPTS) >= 6


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_an_example_writes_what_is_shown(script, folder):
    for name in OPTIONAL:
        if name in script.stem:
            pytest.importorskip(name)
    before = set(folder.iterdir())
    names = runpy.run_path(str(folder / script.name))
    if "pictures" in names:
        written = {path for path in set(folder.iterdir()) - before if path.suffix == ".png"}
        assert len(written) == len(names["pictures"])
        assert all((EXAMPLES / path.name).exists() for path in written)
        return
    drawings = names.get("drawings") or [names["drawing"]]
    assert all(any(line.visible for line in drawing.lines) for drawing in drawings)

    written = {path for path in set(folder.iterdir()) - before if path.suffix in (".svg", ".pdf")}
    assert len(written) == len(drawings)
    for path in written:
        shown = (EXAMPLES / path.name).read_bytes()
        made = path.read_bytes()
        if path.suffix == ".pdf":
            assert made.startswith(b"%PDF-") and shown.startswith(b"%PDF-")
            continue
        # Triangulations differ between versions of OpenCASCADE: the same parts, and nearly as many lines.
        assert len(PART.findall(made)) == len(PART.findall(shown)) > 0
        assert paths(made) == pytest.approx(paths(shown), rel=0.25, abs=5)
        assert paths(made) > 0


def test_the_gallery_shows_every_example():
    text = (EXAMPLES / "README.md").read_text("utf-8")
    linked = set(re.findall(r"\]\(([^)]+)\)", text))
    for name in linked:
        assert (EXAMPLES / name).exists(), f"the gallery links {name}, which is not there"
    assert {script.name for script in SCRIPTS} <= linked
    assert {path.name for end in ("svg", "pdf", "png") for path in EXAMPLES.glob(f"*.{end}")} <= linked


def test_every_model_has_its_licence_and_is_used():
    licences = (EXAMPLES / "models" / "LICENSES.md").read_text("utf-8")
    scripts = "".join(path.read_text("utf-8") for path in SCRIPTS)
    for path in (EXAMPLES / "models").iterdir():
        if path.suffix != ".md":
            assert f"| {path.name} |" in licences
            assert path.name in scripts


def test_the_examples_stay_small():
    assert sum(path.stat().st_size for path in EXAMPLES.rglob("*") if path.is_file()) < 12e6


def test_the_readme_draws_a_model_that_is_there():
    text = (EXAMPLES.parent / "README.md").read_text("utf-8")
    (model,) = re.findall(r"pip install \. && hlr draw (\S+)", text)
    assert (EXAMPLES.parent / model).is_file()
    for name in re.findall(r"\]\(((?:examples|hlr|tests)/[^)]*|[A-Z]+(?:\.md)?)\)", text):
        assert (EXAMPLES.parent / name).exists(), f"the README links {name}, which is not there"
