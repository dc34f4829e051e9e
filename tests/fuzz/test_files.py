"""Broken and hostile files: a drawing or one sentence, in bounded memory and time, and the earlier output intact."""

from __future__ import annotations

import contextlib
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("cadquery")
if not hasattr(os, "fork"):
    pytest.skip("the warm process forks", allow_module_level=True)

from fuzz import hostile
from fuzz.mutate import mutate
from fuzz.warm import Result, Warm

CORPUS = Path(__file__).parent / "corpus"
SEEDS = sorted(CORPUS.glob("seeds/*"))
BROKEN = sorted(CORPUS.glob("broken/*"))
MUTANTS = 6
"""Of each seed."""

OPENCASCADE = (".step", ".igs", ".brep", ".brp")
"""Files that may crash the reader, or never let it go: the guard of the command line, tested below, makes a sentence of
a crash, and Ctrl-C ends the rest."""

SECONDS = 2
"""For OpenCASCADE on a broken file: sound ones of this size take a tenth of it."""


@pytest.fixture(scope="module")
def warm() -> Iterator[Warm]:
    process = Warm()
    yield process
    process.close()


def judge(warm: Warm, name: str, data: bytes) -> None:
    cad = name.endswith(OPENCASCADE)
    result = warm.draw(name, data, SECONDS) if cad else warm.draw(name, data)
    fault = result.fault(name)
    if cad and fault and fault.startswith(("crash", "hang")):
        assert result.files["out.svg"] == b"old"
        return
    assert fault is None, fault


@pytest.mark.slow
@pytest.mark.parametrize("path", SEEDS, ids=lambda path: path.name)
def test_seeds_are_drawn(warm: Warm, path: Path) -> None:
    result = warm.draw(path.name, path.read_bytes())
    assert (result.code, result.fault(path.name)) == (0, None)


@pytest.mark.parametrize("path", BROKEN, ids=lambda path: path.name)
def test_files_that_once_failed(warm: Warm, path: Path) -> None:
    judge(warm, path.name, path.read_bytes())


@pytest.mark.slow
@pytest.mark.parametrize("path", SEEDS, ids=lambda path: path.name)
def test_mutants(warm: Warm, path: Path) -> None:
    rng = random.Random(path.name)
    data = path.read_bytes()
    for _ in range(MUTANTS):
        judge(warm, path.name, mutate(rng, path.suffix[1:], data, [data]))


@pytest.mark.parametrize("name", hostile.FILES)
def test_hostile_files(warm: Warm, name: str) -> None:
    judge(warm, name, hostile.FILES[name])


@pytest.mark.slow
def test_a_wrong_outcome_would_be_noticed() -> None:
    def fault(code: int, err: str = "", out: bytes = b"old", **more: bytes) -> str:
        files = {"a.stl": b"", "out.svg": out, **more}
        return (Result(code, err, files, 0.0).fault("a.stl") or "").partition(" ")[0]

    drawn = b"<?xml version='1.0'?><svg></svg>\n"
    assert fault(0, "hlr: warning: open\n", drawn) == fault(2, "hlr: a.stl is empty\n") == ""
    assert fault(70, "hlr: internal error: ...\n") == "fault"
    assert fault(2, "Traceback (most recent call last):\n") == "fault"
    assert fault(2) == fault(2, "hlr: one\nhlr: two\n") == "sentence"
    assert fault(2, "overflow encountered\nhlr: one\n") == fault(0, "a word\n", drawn) == "noise"
    assert fault(2, "hlr: one\n", drawn) == fault(0, "", drawn[:-9]) == fault(0) == "output"
    assert fault(2, "hlr: one\n", **{".out.svg.1f.tmp": b""}) == "strays"
    assert fault(-signal.SIGSEGV) == "crash"
    assert fault(-signal.SIGALRM) == "hang"


def hlr(folder: Path, *arguments: str) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-P", "-m", "hlr", *arguments]
    return subprocess.Popen(command, cwd=folder, start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["reference-to-nothing.step", "line-broken.igs", "shape-out-of-range.brep"])
def test_what_crashes_opencascade_is_refused_in_a_sentence(tmp_path: Path, name: str) -> None:
    """Should a newer OpenCASCADE refuse these files itself, so much the better."""
    (tmp_path / name).write_bytes((CORPUS / "broken" / name).read_bytes())
    (tmp_path / "out.svg").write_bytes(b"old")
    process = hlr(tmp_path, "draw", name, "-o", "out.svg")
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (2, b"")
    assert err.startswith(f"hlr: {name} ".encode())
    assert err.count(b"\n") == 1
    assert (tmp_path / "out.svg").read_bytes() == b"old"
    assert {path.name for path in tmp_path.iterdir()} == {name, "out.svg"}


@pytest.mark.slow
def test_ctrl_c_ends_a_file_that_opencascade_never_finishes(tmp_path: Path) -> None:
    process = hlr(tmp_path, "draw", str(CORPUS / "endless" / "curve-without-end.brep"), "-o", "out.svg")
    time.sleep(2.0)
    process.send_signal(signal.SIGINT)
    try:
        _, err = process.communicate(timeout=10)
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    assert (process.returncode, err) in [(-signal.SIGINT, b""), (2, err)]
    assert not list(tmp_path.iterdir())
