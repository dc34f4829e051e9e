"""Parameters of scripts in a manifest: what no script takes is refused before any of them runs."""

import re

import pytest
from batch.models import FakePool, Silent

from hlr.batch.kept import Kept
from hlr.batch.keys import Digests
from hlr.batch.manifest import read
from hlr.batch.plan import plan
from hlr.batch.run import run
from hlr.errors import OptionError


def titles(folder, text):
    """The jobs of a manifest that come to a pool."""
    file = folder / "hlr.toml"
    file.write_text(text)
    pool = FakePool()
    run(plan(read(file), folder / "drawings"), Kept(None, Digests()), pool, Silent())
    return pool.asked


@pytest.fixture
def scripts(tmp_path):
    (tmp_path / "a.py").write_text("size = 10\nlabel = 'A'\nraise SystemExit('this script is run')\n")
    (tmp_path / "b.py").write_text("wall = 2\n")
    return tmp_path


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("files = 'a.py'\nparameters = { sise = 3 }", "hlr.toml, line 2, parameters.sise: a.py has no parameter sise: "
         "did you mean size?"),
        ("[[source]]\nfiles = 'b.py'\n[[source]]\nfiles = 'a.py'\nparameters.depth = [1, 2]",
         "hlr.toml, line 5, source.parameters.depth: a.py has no parameter depth: its parameters are size, label"),
        ("files = 'a.py'\n[parameters]\nlabel = 'B'\nsize = [1, 'x']",
         "hlr.toml, line 4, parameters.size: the parameter size of a.py is a number, such as 10, not 'x'"),
        # At the top parameters are for the scripts of all tables, and these have it in none.
        ("[parameters]\ndepth = 1\n[[source]]\nfiles = 'a.py'\n[[source]]\nfiles = 'b.py'",
         "hlr.toml, line 2, parameters.depth: a.py has no parameter depth: its parameters are size, label"),
    ],
)  # fmt: skip
def test_what_no_script_takes_is_refused_before_one_runs(scripts, text, message):
    with pytest.raises(OptionError, match="^" + re.escape(message)):
        titles(scripts, text)


def test_one_script_that_takes_it_is_enough(scripts):
    assert titles(scripts, "files = ['b.py', 'a.py']\nparameters.size = 3\n") == ["a.py size=3", "b.py size=3"]
    text = "[parameters]\nwall = 1\n[[source]]\nfiles = 'a.py'\n[[source]]\nfiles = 'b.py'\n"
    assert titles(scripts, text) == ["a.py wall=1", "b.py wall=1"]
    # A table of its own answers for itself.
    with pytest.raises(OptionError, match=r"a\.py has no parameter wall"):
        titles(scripts, "[[source]]\nfiles = 'a.py'\nparameters.wall = 1\n[[source]]\nfiles = 'b.py'\n")


def test_a_script_that_cannot_be_read_is_left_to_its_run(scripts):
    (scripts / "a.py").write_text("size = (")
    assert titles(scripts, "files = 'a.py'\nparameters.size = 3\n") == ["a.py size=3"]
