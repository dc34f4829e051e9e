"""The pages for people: their links lead somewhere, and a newcomer finds the pages that explain the rest."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("examples", "hlr", "tests")
PAGES = sorted({*ROOT.glob("*.md"), *(p for f in FOLDERS for p in (ROOT / f).rglob("*.md") if "target" not in p.parts)})
LINK = re.compile(r"\]\(([^)\s]+)\)|src=\"([^\"]+)\"")
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)


def anchors(page):
    """What a heading of a page is called in a link."""
    titles = re.findall(r"^#+ (.*)$", page.read_text("utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def broken(page):
    """Links of a page within the repository that lead nowhere."""
    for found in LINK.finditer(CODE.sub("", page.read_text("utf-8"))):
        link = found[1] or found[2]
        if re.match(r"\w+:", link):
            continue
        name, _, heading = link.partition("#")
        target = page.parent / name if name else page
        if not target.exists() or (heading and heading not in anchors(target)):
            yield link


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_leads_somewhere(page):
    assert not list(broken(page))


FILES = {f"/{path.relative_to(ROOT).as_posix()}" for end in ("py", "rs") for path in ROOT.rglob(f"*.{end}")}


def missing(page):
    """Files of code that a page names, and that are not there: by their path, or the end of it."""
    named = re.findall(r"`((?:[\w-]+/)*\w+\.(?:py|rs))`", page.read_text("utf-8"))
    return [name for name in named if not any(path.endswith(f"/{name}") for path in FILES)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_file_of_code_that_a_page_names_is_there(page):
    assert not missing(page)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_program_that_a_page_runs_is_there(page):
    text = page.read_text("utf-8")
    paths = re.findall(r"python ((?:tests|examples)/\S+\.py)", text)
    folders = "|".join(path.name for path in (ROOT / "tests").iterdir() if path.is_dir())
    modules = re.findall(rf"python -m ((?:{folders})(?:\.\w+)+)", text)
    paths += [f"tests/{name.replace('.', '/')}.py" for name in modules]
    assert [path for path in paths if not (ROOT / path).is_file()] == []


def test_a_file_that_is_not_there_is_found(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("`session.py`, `pipeline/session.py`, `pipeline/nothing.py`\n")
    assert missing(page) == ["pipeline/nothing.py"]


def test_a_broken_link_is_found(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("# One, two\n[a](none.md) [b](#three) [c](#one-two) [d](page.md) `[e](none.md)`\n")
    assert list(broken(page)) == ["none.md", "#three"]


def test_the_readme_leads_to_every_page_of_docs():
    pages = [path for path in (ROOT / "hlr/docs").glob("*.md")]
    linked = set(LINK.findall((ROOT / "README.md").read_text("utf-8")))
    assert {f"hlr/docs/{path.name}" for path in pages} == {link for link, _ in linked if link.startswith("hlr/docs/")}


def test_a_newcomer_finds_the_pages_to_begin_with_at_the_top_of_the_readme():
    top = (ROOT / "README.md").read_text("utf-8").partition("\n## ")[0]
    pages = ("hlr/docs/ARCHITECTURE.md", "hlr/docs/GLOSSARY.md", "hlr/docs/CONTRIBUTING.md")
    assert all(f"]({page})" in top for page in pages)
    contributing = (ROOT / "hlr/docs/CONTRIBUTING.md").read_text("utf-8")
    assert all(f"]({page.rpartition('/')[2]})" in contributing for page in pages[:2])
