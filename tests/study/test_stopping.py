"""A study that is stopped, or a point that takes too long, ends at once, and with it what a script has started."""

import os
import signal
import subprocess
import sys
import time

import pytest

from hlr.common.process import is_own
from hlr.lab.study.job import Job
from hlr.lab.study.process import answer
from support.programs import environment

if not hasattr(os, "fork"):
    pytest.skip("signals end processes differently here", allow_module_level=True)

pytestmark = pytest.mark.slow

# A solver as others start it, and one in a session of its own that ignores what can be ignored.
SCRIPT = """
import signal, subprocess, sys, time
deaf = "import signal, time; [signal.signal(n, signal.SIG_IGN) for n in (2, 15)]; print(flush=True); time.sleep(99)"
with open("solvers", "a") as file:
    for alone in (False, True):
        solver = subprocess.Popen([sys.executable, "-c", deaf], stdout=subprocess.PIPE, start_new_session=alone)
        solver.stdout.readline()
        print(solver.pid, file=file, flush=True)
open("started", "w").close()
"""


@pytest.fixture
def study(tmp_path):
    """Start `hlr study` on a script that starts two solvers and ends like this. Returns the process."""
    started = []

    def start(end, *arguments):
        (tmp_path / "part.py").write_text(SCRIPT + end)
        command = [sys.executable, "-P", "-m", "hlr", "study", "part.py", "-o", "figures", *arguments]
        # In a group of its own, as one that a terminal starts.
        process = subprocess.Popen(
            command, cwd=tmp_path, env=environment(), stderr=subprocess.PIPE, text=True, start_new_session=True
        )
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()
    for solver in solvers(tmp_path):
        if runs(solver):
            os.kill(solver, signal.SIGKILL)


def solvers(folder):
    return [int(line) for line in (folder / "solvers").read_text().split()]


def runs(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True


def wait_for(path, seconds=30.0):
    end = time.monotonic() + seconds
    while not path.exists() and time.monotonic() < end:
        time.sleep(0.02)
    assert path.exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_all_of_it_at_once(study, tmp_path, number):
    process = study("signal.signal(signal.SIGINT, signal.SIG_IGN)\ntime.sleep(99)\n")
    wait_for(tmp_path / "started")
    process.send_signal(number)
    assert process.wait(timeout=5.0) == -number  # a script that ignores signals has two seconds of any command
    assert len(solvers(tmp_path)) == 2 and not any(map(runs, solvers(tmp_path)))
    assert not (tmp_path / "figures").exists()


def test_a_point_that_takes_too_long_ends_all_of_it(study, tmp_path):
    process = study("while True:\n    pass\n", "--limit", "0.3")
    _, said = process.communicate(timeout=60.0)
    assert process.returncode == 2 and said.count("\n") == 1
    assert said.endswith("part.py cannot be studied: not finished in 0.9 s of processor time.\n")
    assert len(solvers(tmp_path)) == 2 and not any(map(runs, solvers(tmp_path)))


def test_in_another_program_its_own_children_stay(tmp_path):
    """Only where the process is the command's are its children known to be the script's."""
    assert not is_own()
    other = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(99)"])
    try:
        assert answer(Job("look", str(tmp_path / "none.stl"), setting=0.1, limit=9.0))["failure"]
        assert other.poll() is None
    finally:
        other.kill()
        other.wait()
