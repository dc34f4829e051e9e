import contextlib
import os
import select
import signal
import subprocess
import sys
import time
from typing import NamedTuple

import pytest

from support import fake_pipeline as fake
from support.programs import environment

# The command line with a file that takes its time, to be written and to be removed.
WRITE_SLOWLY = """
import os, sys, time
from support import fake_pipeline as fake
from hlr.cli import main
from hlr.drawing import files

def write(file, data):
    file.write(data)
    print("writing", file=sys.stderr, flush=True)
    time.sleep(20)

def unlink(path):
    time.sleep(0.3)
    remove(path)

remove, os.unlink = os.unlink, unlink
files._write = write
fake.install()
main()
"""


class Result(NamedTuple):
    code: int
    out: str
    err: str


@pytest.fixture
def hlr_real(monkeypatch, capfd, tmp_path):
    """Run the command line in this process, in an empty folder."""
    from hlr.cli import main

    monkeypatch.chdir(tmp_path)
    before = signal.getsignal(signal.SIGINT)

    def run(*arguments):
        with pytest.raises(SystemExit) as left:
            main([str(argument) for argument in arguments])
        out, err = capfd.readouterr()
        return Result(left.value.code or 0, out, err)

    yield run
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def hlr_command(hlr_real, monkeypatch):
    """The same on the stand-in pipeline."""
    import hlr

    monkeypatch.setattr(hlr, "draw_views", fake.draw_views, raising=False)
    monkeypatch.setattr(hlr, "info", fake.info, raising=False)
    return hlr_real


def as_from_a_terminal():
    """Whatever the tests' own program ignores (it may run under nohup, or in the background): children do not."""
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


@pytest.fixture
def started(tmp_path):
    """Start a program with arguments in an empty folder; what still runs of its group after the test is killed."""
    processes = []

    def start(program, *arguments, **options):
        options.setdefault("preexec_fn", as_from_a_terminal)
        options.setdefault("env", environment())
        process = subprocess.Popen([*program, *arguments], cwd=tmp_path, **options | {"start_new_session": True})
        processes.append(process)
        return process

    yield start
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@pytest.fixture
def child(started):
    """Start the command line as a process of its own, on the stand-in pipeline."""

    def start(*arguments, **options):
        return started(fake.PROGRAM, *arguments, **options)

    return start


@pytest.fixture
def slow_writer(started, tmp_path):
    """Start the command line and return while it writes over `a.svg`, which says "old"."""

    def start(**options):
        (tmp_path / "a.svg").write_text("old")
        program = [sys.executable, "-P", "-c", WRITE_SLOWLY]
        process = started(program, "draw", "a.step", "-o", "a.svg", stderr=subprocess.PIPE, **options)
        assert process.stderr.readline() == b"writing\n"
        return process

    return start


@pytest.fixture
def on_terminal(child):
    """Run the command with a terminal as standard error: what it shows there, and its exit code.

    interrupt: press Ctrl-C when this is shown.
    """
    pty = pytest.importorskip("pty")

    def run(*arguments, columns=80, seconds=20.0, interrupt=None):
        control, terminal = pty.openpty()
        variables = environment(TERM="xterm", COLUMNS=str(columns))
        process = child(*arguments, stderr=terminal, env=variables)
        os.close(terminal)
        shown, end = b"", time.monotonic() + seconds
        while time.monotonic() < end:
            if select.select([control], [], [], 0.05)[0]:
                try:
                    piece = os.read(control, 65536)
                except OSError:  # Linux reports the last writer's end as an error
                    break
                if not piece:
                    break
                shown += piece
                if interrupt and interrupt.encode() in shown:
                    os.killpg(process.pid, signal.SIGINT)  # as the terminal does: to the whole group
                    interrupt = None
        os.close(control)
        return shown.decode(), process.wait(timeout=5)

    return run
