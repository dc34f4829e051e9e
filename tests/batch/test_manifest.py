"""Manifests: what they may say, and the line and key of what they may not."""

import re

import pytest
from batch.models import tetrahedron

from hlr.batch.first_manifest import text_for
from hlr.batch.lines import line_of
from hlr.batch.manifest import find, read
from hlr.batch.schema import KEYS
from hlr.errors import OptionError


def manifest(folder, text, name="hlr.toml"):
    file = folder / name
    file.write_text(text)
    return read(file)


def test_the_top_holds_what_all_sources_share(tmp_path):
    text = 'views = "iso"\nhidden = false\n[[source]]\nfiles = "a.off"\n[[source]]\nfiles = "b.off"\nviews = ["top"]\n'
    first, second = manifest(tmp_path, text).rules
    assert (first.values["views"], first.options, first.where) == ("iso", {"hidden": False}, ("source", 0))
    assert (second.values["views"], second.values["formats"]) == (["top"], ["svg"])


def test_it_may_stand_in_pyproject(tmp_path):
    assert find(tmp_path) is None
    (tmp_path / "pyproject.toml").write_text("[project]\nname = 'a'\n")
    assert find(tmp_path) is None
    found = manifest(tmp_path, "[tool.hlr]\noutput = 'out'\nscale = 2.0\n", "pyproject.toml")
    assert find(tmp_path) == found.file and found.output == "out" and found.rules[0].options == {"scale": 2.0}
    (tmp_path / "hlr.toml").touch()
    assert find(tmp_path).name == "hlr.toml"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("veiws = 'iso'", "hlr.toml, line 1, veiws: there is no such key: did you mean views?"),
        ("\n# one\nviews = 3", "hlr.toml, line 3, views: names of views, or directions such as [1, -1, 1] is needed"),
        ("output = ''", "line 1, output: the name of a folder is needed, not ''"),
        ("formats = ['svg',\n 'dwg']", "line 1, formats: there is no format 'dwg': use svg, "),
        ("time_limit_s = 0", "line 1, time_limit_s: a positive number is needed, not 0"),
        (
            "total_time_limit_s = -1",
            "line 1, total_time_limit_s: a positive number, or 0 for no limit is needed, not -1",
        ),
        ("[[source]]\nfiles='b'\ntotal_time_limit_s=9", "line 3, source.total_time_limit_s: it belongs to the top"),
        ("[[source]]\nviews = 'iso'", "line 1, source: this [[source]] names no files"),
        ("[[source]]\nfiles='a'\n[[source]]\nfiles='b'\noutput='c'", "line 5, source.output: it belongs to the top"),
        ("[source]\nfiles = 'a'", "line 1, source: write [[source]] with double brackets"),
        ("parameters = { size = [] }", "line 1, parameters: a table of names with a value, or a list of values"),
        ("[tool.ruff]\na = 1", "hlr.toml, line 1, tool: tables [tool] belong to pyproject.toml: write keys without"),
        ("[source.hlr]\na = 1", "hlr.toml, line 1, source: write [[source]]"),
        ("hlr = 1", "hlr.toml, line 1, hlr: there is no such key"),
        ("a = [1,\n2", "hlr.toml is no TOML: "),
        ("views = 'iso", "hlr.toml is no TOML: Expected"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, text, message):
    with pytest.raises(OptionError, match=re.escape(message)):
        manifest(tmp_path, text)


@pytest.mark.parametrize("text", ["", "tool = 3", "tool = 'hlr'", "[tool.ruff]\na = 1"])
def test_a_project_without_the_table_is_no_manifest(tmp_path, text):
    with pytest.raises(
        OptionError, match=r"pyproject\.toml has no table \[tool\.hlr\]: write one, or name a folder or"
    ):
        manifest(tmp_path, text, "pyproject.toml")
    assert find(tmp_path) is None


def test_a_key_of_a_project_is_named_without_its_table(tmp_path):
    with pytest.raises(OptionError, match=r"^pyproject\.toml, line 2, veiws: there is no such key"):
        manifest(tmp_path, "[tool.hlr]\nveiws = 'iso'\n", "pyproject.toml")
    with pytest.raises(OptionError, match=r"^pyproject\.toml, line 1: a table is needed"):
        manifest(tmp_path, "tool = { hlr = 3 }\n", "pyproject.toml")


def test_a_line_is_found_whatever_stands_before_it():
    text = 'a = """\nviews = 1\n"""\nb = [\n  "views",\n]\n[[source]]\nviews = [\n 1]\n[[source]] # views\nviews = 2\n'
    assert line_of(text, ("views",)) is None
    assert line_of(text, ("source", 0, "views")) == 8
    assert line_of(text, ("source", 1, "views")) == 11
    assert line_of(text, ("source", 1)) == 10


def test_the_first_manifest_says_what_holds_without_one(tmp_path):
    tetrahedron(tmp_path / "parts" / "a.off")
    text = text_for(tmp_path)
    found = manifest(tmp_path, text)
    assert found.rules[0].values == {**{name: key.default for name, key in KEYS.items()}, "files": ["**/*.off"]}
    # What is commented out is right as well.
    again = manifest(tmp_path, re.sub(r"^# (\w+ = .*)$", r"\1", text.partition("# Any option")[0], flags=re.MULTILINE))
    assert again.rules[0].values.keys() == KEYS.keys() and again.output == "drawings"
