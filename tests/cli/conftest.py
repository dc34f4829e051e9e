import signal
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import fake_pipeline as fake
import pytest

FAKE = [sys.executable, str(Path(fake.__file__))]


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


@pytest.fixture
def child(tmp_path):
    """Start the command line as a process of its own, on the stand-in pipeline."""
    started = []

    def start(*arguments, **options):
        process = subprocess.Popen([*FAKE, *arguments], cwd=tmp_path, **options)
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()
