"""The pool of worker processes: whatever a source does costs that source alone."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace

import pytest
from batch.models import tetrahedron

from hlr.batch.job import Job, Outcome
from hlr.batch.pool import LocalPool
from hlr.batch.worker import Begun, Ended, _Running

SCRIPTS = {
    "exits.py": "import os\nos._exit(3)\n",
    "crashes.py": "import ctypes\nctypes.string_at(0)\n",
    "killed.py": "import os\nos.kill(os.getpid(), 9)\n",
    "endless.py": "while True: pass\n",
    "greedy.py": "import time\nheld = bytearray(b'x') * 700_000_000\ntime.sleep(60)\n",
    "wrong.py": "1 / 0\n",
    "leaves.py": "import sys\nsys.exit(4)\n",
    "noisy.py": "import os\nprint('x' * 100_000)\nos.write(1, b'y' * 100_000)\n1 / 0\n",
}
SAID = {
    "exits.py": "exits.py ended its process before anything was drawn",
    "crashes.py": r"crashes.py crashed \(segmentation fault\)",
    "killed.py": "killed.py: the work was killed, most likely for want of memory",
    "endless.py": r"endless.py took longer than 2 s and was given up; the script itself ran for (2\.\d|1\.9) s of "
    r"that: raise time_limit_s \(--time-limit\), or make the script faster\.$",
    "greedy.py": r"greedy.py took more than 500 MB of memory and was given up: raise memory_limit_mb\.$",
    "wrong.py": "wrong.py, line 1: ZeroDivisionError: division by zero",
    "leaves.py": "leaves.py left with exit code 4",
    "noisy.py": "noisy.py, line 4: ZeroDivisionError",
}


def job(root, source, **more):
    files = ((f"{source}.svg",),)
    return Job(str(root), source, ("iso",), ("svg",), files, {"threads": 1}, time_limit_s=60.0, **more)


@pytest.fixture
def pool():
    pool = LocalPool(2)
    yield pool
    pool.close()


@pytest.mark.slow
def test_what_a_source_does_costs_that_source_alone(pool, tmp_path):
    jobs = []
    for number, (name, text) in enumerate(SCRIPTS.items()):
        (tmp_path / name).write_text(text)
        limits = {"time_limit_s": 2.0} if name == "endless.py" else {}
        jobs.append(replace(job(tmp_path, name, memory_limit_mb=500.0), **limits))
        jobs.append(job(tmp_path, tetrahedron(tmp_path / f"{number}.off", number + 1).name))
    outcomes = {jobs[e.number].source: e.outcome for e in pool.run(jobs) if e.outcome is not None}
    assert outcomes.keys() == {job.source for job in jobs}
    for name, outcome in outcomes.items():
        if name in SAID:
            assert outcome.failure is not None and re.match(SAID[name], outcome.failure.message)
        else:
            assert outcome.failure is None and outcome.contents[0][0].startswith(b"<?xml")
            assert outcome.peak_memory_mb > 10.0 or sys.platform == "win32"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the worker itself imports nothing where it does not fork")
@pytest.mark.parametrize(
    ("then", "words"),
    [
        ("while True: pass", "part.py took longer than 3 s and was given up; the script itself ran"),
        ("1 / 0", "Division"),
    ],
)
def test_a_time_limit_is_for_what_follows_the_import_of_a_package(tmp_path, then, words):
    (tmp_path / "modules").mkdir()
    (tmp_path / "modules/build123d.py").write_text("import time\ntime.sleep(5)\n")
    (tmp_path / "part.py").write_text(f"import build123d\n{then}\n")
    pool = LocalPool(1, {"PYTHONPATH": str(tmp_path / "modules")})
    try:
        limited = replace(job(tmp_path, "part.py"), time_limit_s=3.0)
        last = list(pool.run([limited], time.monotonic() + 60.0))[-1]
    finally:
        pool.close()
    assert last.outcome is not None, "it ran on"
    assert words in last.outcome.failure.message


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs POSIX signals")
def test_what_was_given_up_ends_where_it_goes_on_in_another_process(tmp_path):
    running = _Running(replace(job(tmp_path, "endless.py"), time_limit_s=0.0))
    first, second = (subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) for _ in range(2))
    running.moved(first.pid)
    first.communicate(b"\n")
    running.keep_within_limits()
    running.moved(second.pid)
    assert (second.wait(10), running.verdict[0]) == (-signal.SIGKILL, "TimeLimit")


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs POSIX signals")
def test_a_killed_worker_is_replaced(pool, tmp_path):
    jobs = [job(tmp_path, tetrahedron(tmp_path / f"{n}.off", n + 1).name) for n in range(6)]
    killed, outcomes = [], []
    for event in pool.run(jobs):
        if event.outcome is None and not killed:
            process = pool._workers[0]._process
            killed.append(process.pid)
            os.kill(process.pid, signal.SIGKILL)
        elif event.outcome is not None:
            outcomes.append(event.outcome)
    assert len(outcomes) == 6 and sum(outcome.failure is not None for outcome in outcomes) <= 1
    assert all(w._process is None or w._process.pid not in killed for w in pool._workers)


@pytest.mark.slow
def test_nothing_of_one_script_reaches_the_next(tmp_path):
    for folder in ("one", "other"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "lib.py").write_text(f"where = {folder!r}\n")
        text = (
            "import os, lib\nassert not os.environ.get('SEEN')\nos.environ['SEEN'] = '1'\nraise ValueError(lib.where)\n"
        )
        (tmp_path / folder / "part.py").write_text(text)
    pool = LocalPool(1)
    try:
        jobs = [job(tmp_path, "one/part.py"), job(tmp_path, "other/part.py")]
        outcomes = [event.outcome for event in pool.run(jobs) if event.outcome is not None]
    finally:
        pool.close()
    assert [outcome.failure.message[-6:] for outcome in outcomes] == [": one.", "other."]
    assert [outcome.depends for outcome in outcomes] == [("one/lib.py",), ("other/lib.py",)]


def test_limits_are_kept_though_something_is_said_all_the_time(monkeypatch, tmp_path):
    looks = []

    class Talker:
        """A worker that says something every hundredth of a second, and ends after half a second."""

        def __init__(self, said, environment):
            self.said = said

        def give(self, number, job):
            def talk():
                for _ in range(50):
                    time.sleep(0.01)
                    self.said.put(Begun(number, "source"))
                self.said.put(Ended(number, Outcome(), self))

            threading.Thread(target=talk, daemon=True).start()

        def keep_within_limits(self):
            looks.append(time.monotonic())

    monkeypatch.setattr("hlr.batch.pool.Worker", Talker)
    assert list(LocalPool(1).run([job(tmp_path, "part.off")]))[-1].outcome is not None
    assert len(looks) >= 2


@pytest.mark.slow
def test_a_job_that_was_given_up_says_nothing_to_the_next(tmp_path):
    (tmp_path / "endless.py").write_text("while True: pass\n")
    tetrahedron(tmp_path / "part.off", 1)
    wishes = iter([True, False])
    pool = LocalPool(1, wanted=lambda: next(wishes, True))
    try:
        assert [event for event in pool.run([job(tmp_path, "endless.py")]) if event.outcome is not None] == []
        (outcome,) = [e.outcome for e in pool.run([job(tmp_path, "part.off")]) if e.outcome is not None]
    finally:
        pool.close()
    assert outcome.failure is None


@pytest.mark.slow
def test_at_the_deadline_all_that_runs_is_ended_and_nothing_begins(tmp_path):
    (tmp_path / "endless.py").write_text(
        f"import os\nopen({str(tmp_path / 'pid')!r}, 'w').write(str(os.getpid()))\n" + SCRIPTS["endless.py"]
    )
    for name in ("first.off", "last.off"):
        tetrahedron(tmp_path / name, 1)
    jobs = [job(tmp_path, name) for name in ("first.off", "endless.py", "last.off")]
    pool = LocalPool(1)
    events = list(pool.run(jobs, time.monotonic() + 8.0))
    assert [event.number for event in events if event.outcome is not None] == [0]
    assert {event.number for event in events} == {0, 1}
    end = time.monotonic() + 5.0
    while still_runs(tmp_path / "pid"):  # a killed process takes a moment to end
        assert time.monotonic() < end
    assert not pool._workers
    assert list(pool.run(jobs, time.monotonic() - 1.0)) == []


def test_a_worker_that_cannot_be_started_is_told(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    pool = LocalPool(1)
    outcomes = [event.outcome for event in pool.run([job(tmp_path, f"{n}.off") for n in range(2)])]
    pool.close()
    message = f"0.off: no process to draw it can be started with {tmp_path}/python: no such file or directory."
    assert outcomes[0].failure.message == message and len(outcomes) == 2


def test_what_has_ended_before_the_deadline_is_told(monkeypatch):
    class Quick:
        """A worker that is done at once; nobody has looked yet."""

        def __init__(self, said, environment):
            self.said = said

        def give(self, number, job):
            self.said.put(Ended(number, Outcome(), self))

        def end(self): ...

        def wait(self): ...

    monkeypatch.setattr("hlr.batch.pool.Worker", Quick)
    events = list(LocalPool(2).run([job("/", f"{n}.off") for n in range(3)], time.monotonic()))
    assert [event.number for event in events] == [0, 1]


STARTS = """
import os, subprocess, sys, time
started = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"], start_new_session=True)
open("started-" + os.path.basename(__file__), "w").write(str(started.pid))
"""


def still_runs(path):
    """Whether a process runs whose number a file names."""
    import psutil

    try:
        return psutil.Process(int(path.read_text())).status() != "zombie"
    except psutil.NoSuchProcess:
        return False


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the worker does the job itself")
def test_what_a_script_has_started_ends_where_its_job_fails(pool, tmp_path):
    ends = {"aborts.py": "os.abort()", "fails.py": "1 / 0", "endless.py": "while True: pass"}
    for name, end in ends.items():
        (tmp_path / name).write_text(f"{STARTS}{end}\n")
    jobs = [replace(job(tmp_path, name), time_limit_s=2.0) for name in ends]
    outcomes = [event.outcome for event in pool.run(jobs) if event.outcome is not None]
    assert len(outcomes) == 3 and all(outcome.failure is not None for outcome in outcomes)
    assert [name for name in ends if still_runs(tmp_path / f"started-{name}")] == []
