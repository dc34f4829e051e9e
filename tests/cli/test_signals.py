"""A signal while files are written ends the command, even where its exception is lost on the way."""

import os
import signal
import subprocess
import sys

import pytest

pytestmark = pytest.mark.skipif(os.name != "posix", reason="needs signals")

FRAME = """
import gc, os, signal, time
from hlr.cli.signals import Stopped, at_once, die_by, tidily

class Destroyed:
    def __del__(self):
        os.kill(os.getpid(), {number})
        time.sleep(0.001)

def collecting(phase, _info):
    if phase == "start":
        os.kill(os.getpid(), {number})
        time.sleep(0.001)

at_once(own=True)
try:
    with tidily() as asked:
        {inside}
except Stopped as stopped:
    die_by(stopped.number)
"""


def ends(tmp_path, inside, number=signal.SIGINT):
    """How the program ends, and what it says."""
    program = FRAME.format(inside=inside.replace("\n", "\n        "), number=int(number))
    command = [sys.executable, "-P", "-c", program]
    done = subprocess.run(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, timeout=20, check=False)
    return done.returncode, done.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_in_a_destructor(tmp_path, number):
    assert ends(tmp_path, "Destroyed()\ntime.sleep(10)\nos._exit(7)", number) == (-number, "")


def test_in_several_destructors(tmp_path):
    assert ends(tmp_path, "Destroyed()\nDestroyed()\ntime.sleep(10)\nos._exit(7)") == (-signal.SIGINT, "")


def test_while_a_lost_one_is_sent_again(tmp_path):
    inside = (
        "from types import SimpleNamespace\nfrom hlr.cli import signals\n"
        "start, sent = signals._thread.start_new_thread, []\n"
        "def sending(work, arguments):\n    if not sent:\n        sent.append(1)\n"
        "        os.kill(os.getpid(), signal.SIGINT)\n        time.sleep(0.001)\n    start(work, arguments)\n"
        "signals._thread = SimpleNamespace(start_new_thread=sending)\n"
        "Destroyed()\ntime.sleep(10)\nos._exit(7)"
    )
    assert ends(tmp_path, inside) == (-signal.SIGINT, "")


def test_while_the_garbage_collector_calls_back(tmp_path):
    inside = "gc.callbacks.append(collecting)\ngc.collect()\ngc.callbacks.clear()\ntime.sleep(10)\nos._exit(7)"
    assert ends(tmp_path, inside) == (-signal.SIGINT, "")


def test_where_a_library_takes_it_for_its_own(tmp_path):
    inside = "try:\n    signal.raise_signal(signal.SIGTERM)\nexcept BaseException:\n    pass"
    assert ends(tmp_path, inside) == (-signal.SIGTERM, "")


def test_where_a_library_makes_it_a_keyboard_interrupt(tmp_path):
    inside = "try:\n    signal.raise_signal(signal.SIGTERM)\nexcept BaseException:\n    raise KeyboardInterrupt"
    assert ends(tmp_path, inside) == (-signal.SIGTERM, "")


def test_while_nothing_happens_files_are_watched_until_then(tmp_path):
    inside = (
        "try:\n    signal.raise_signal(signal.SIGINT)\nexcept BaseException:\n    pass\n"
        "from pathlib import Path\nfrom hlr.batch.watch import changes\n"
        "for _ in changes(Path(), Path('out'), set(), asked):\n    pass"
    )
    assert ends(tmp_path, inside) == (-signal.SIGINT, "")


def test_in_a_block_within_another(tmp_path):
    inside = "with tidily():\n    Destroyed()\n    time.sleep(10)\n    os._exit(7)\nos._exit(8)"
    assert ends(tmp_path, inside) == (-signal.SIGINT, "")


def test_no_signal_no_end(tmp_path):
    assert ends(tmp_path, "time.sleep(0.05)") == (0, "")


def test_other_lost_exceptions_are_told_as_ever(tmp_path):
    code, said = ends(tmp_path, "class Bad:\n    def __del__(self):\n        raise ValueError('seven')\nBad()")
    assert code == 0 and "seven" in said
