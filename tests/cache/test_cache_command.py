"""`hlr cache`, `--no-cache`, and what is said of the cache."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

PART = Path(__file__).parents[1] / "data" / "as1-oc-214.stp"


@pytest.fixture
def run(tmp_path):
    def run(*arguments, **environment):
        command = [sys.executable, "-P", "-m", "hlr", *map(str, arguments)]
        ways = {"cwd": tmp_path, "env": os.environ | environment, "timeout": 120}
        return subprocess.run(command, check=False, capture_output=True, text=True, **ways)

    return run


@pytest.mark.slow
def test_a_model_comes_and_goes(run, own_cache, tmp_path):
    assert run("cache", "info").stdout == f"{own_cache}: 0 models, 0.0 MB of at most 1,000.0 MB\n"
    told = run("draw", PART, "-o", "a.svg", "--explain").stderr.splitlines()[-1]
    (path,) = own_cache.iterdir()
    assert told.startswith("as1-oc-214.stp was read in ")
    assert told.endswith(f" and is in the cache now: {path}.")
    told = run("draw", PART, "-o", "b.svg", "--explain").stderr.splitlines()[-1]
    assert told == f"as1-oc-214.stp was not read again, it is in the cache: {path}."
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    known = json.loads(run("cache", "info", "--json").stdout)
    counts = {"models": 1, "drawn": 0, "bytes": path.stat().st_size, "most_bytes": 10**9}
    assert known == {"format": "hlr-cache", "version": 1, "folder": str(own_cache), **counts}
    cleared = run("cache", "clear").stdout
    assert cleared == f"{own_cache}: 1 model removed, {path_size(known)}\n"
    assert list(own_cache.iterdir()) == []


def path_size(known):
    return f"{known['bytes'] / 1e6:,.1f} MB"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "environment"), [(["--no-cache"], {}), ([], {"HLR_CACHE": "off"}), (["--no-cache"], {"HLR_CACHE": "x"})]
)
def test_without_it_nothing_is_kept(options, environment, run, own_cache, tmp_path):
    done = run("draw", PART, "-o", "a.svg", "--explain", *options, **environment)
    assert done.returncode == 0, done.stderr
    assert not own_cache.exists()
    assert not (tmp_path / "x").exists()
    assert done.stderr.splitlines()[-1].endswith("; the cache is off.")


@pytest.mark.slow
@pytest.mark.parametrize("verb", [["plan"], ["info"], ["preview", "-o", "a.png", "--size", "80x60"]])
def test_every_verb_can_do_without_it(verb, own_cache, tmp_path, monkeypatch):
    from hlr.cli import main

    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main([verb[0], str(PART), *verb[1:], "--no-cache", "-q"])
    assert not ended.value.code
    assert not own_cache.exists()


def test_without_it_only_that_command_is(monkeypatch, own_cache, tmp_path):
    """Called from another program, the command leaves its environment as it was."""
    from hlr.cli import main

    for _ in range(2):
        with pytest.raises(SystemExit):
            main(["info", str(PART), "--no-cache", "-q"])
        assert os.environ["HLR_CACHE"] == str(own_cache)
    with pytest.raises(SystemExit):
        main(["info", "missing.step", "--no-cache", "-q"])
    assert os.environ["HLR_CACHE"] == str(own_cache)


def test_off_there_is_nothing_to_say_or_to_clear(run):
    for verb in ("info", "clear"):
        done = run("cache", verb, HLR_CACHE="off")
        assert (done.returncode, done.stdout) == (0, "The cache is off (HLR_CACHE).\n")
    assert json.loads(run("cache", "info", "--json", HLR_CACHE="off").stdout)["folder"] is None


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [["draw", PART, "-o", "a.svg"], ["cache", "info"], ["info", PART]])
def test_a_wrong_size_is_refused_in_a_sentence(run, arguments, tmp_path):
    done = run(*arguments, HLR_CACHE_SIZE="much")
    assert done.returncode == 2
    assert done.stderr == "hlr: HLR_CACHE_SIZE is 'much': give a size such as 500MB or 2GB.\n"
    assert not (tmp_path / "a.svg").exists()


@pytest.mark.slow
def test_a_mesh_does_not_ask_for_the_size(run, tmp_path):
    (tmp_path / "one.off").write_bytes(b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    assert run("draw", "one.off", "-o", "a.svg", HLR_CACHE_SIZE="much").returncode == 0


@pytest.mark.slow
def test_a_folder_that_cannot_be_written_is_said_by_explain_alone(run, tmp_path):
    (tmp_path / "file").write_bytes(b"")
    done = run("draw", PART, "-o", "a.svg", "--strict", HLR_CACHE="file")
    assert (done.returncode, done.stderr) == (0, "")
    told = run("draw", PART, "-o", "a.svg", "--explain", HLR_CACHE="file/in").stderr
    assert "and not kept in the cache (file/in: not a directory)." in told
    assert run("cache", "clear", HLR_CACHE="file").stdout == "file: 0 models removed, 0.0 MB\n"


@pytest.mark.slow
def test_a_crash_while_reading_leaves_nothing(run, own_cache, tmp_path):
    broken = tmp_path / "broken.step"
    broken.write_bytes(PART.read_bytes()[:30000])
    done = run("draw", broken, "-o", "a.svg")
    assert done.returncode == 2
    assert not own_cache.exists()
