"""What a script has started ends with the command, unless that succeeds; and `--time-limit` ends it in time."""

import json
import os
import re
import select
import signal
import subprocess
import sys
import time

import pytest

if not hasattr(os, "fork"):
    pytest.skip("there is no worker without fork", allow_module_level=True)

pytestmark = pytest.mark.slow

HLR = [sys.executable, "-P", "-m", "hlr"]

# Three processes that hold standard error open: one as others start them, one in a session of its own that ignores what
# can be ignored, one forked. Each is there when the script says so.
SCRIPT = """
import os, signal, subprocess, sys, time
program = "import signal, time; {} print('there', flush=True); time.sleep(60)"
deaf = "signal.signal(signal.SIGTERM, signal.SIG_IGN); signal.signal(signal.SIGINT, signal.SIG_IGN);"
plain = "signal.signal(signal.SIGINT, signal.SIG_DFL);"
for reaction in (plain, deaf):
    command = [sys.executable, "-c", program.format(reaction)]
    started = subprocess.Popen(command, stdout=subprocess.PIPE, start_new_session=reaction is deaf)
    started.stdout.readline()
if not os.fork():
    time.sleep(60)
print("started", file=sys.stderr, flush=True)
"""
STAYS = SCRIPT + "time.sleep(60)\n"
IGNORES = STAYS.replace('print("started', 'signal.signal(signal.SIGINT, signal.SIG_IGN)\nprint("started')

# The command line as it is where the system hands down no orphans.
NOT_ADOPTED = """
from hlr.common.leftovers import Leftovers
Leftovers.adopt = lambda self: None
from hlr.cli import main
main()
"""

# The command line with a pipeline that leaves a process behind, and succeeds.
SUCCEEDS = """
import subprocess, sys
import hlr
from support import fake_pipeline as fake
from hlr.cli import main
def draw_views(*arguments, **more):
    print(subprocess.Popen(["sleep", "60"], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL).pid, file=sys.stderr)
    return fake.draw_views(*arguments, **more)
hlr.draw_views = draw_views
main()
"""

# The command line with a large drawing that is never fine enough.
DRAWS_ON = """
import sys, time
import hlr.pipeline.within
from support import fake_pipeline as fake
from hlr.cli import main
def draw_within(opened, views, request, progress, finished, *rest):
    finished(fake.draw_views("large.off", views, request))
    print("started", file=sys.stderr, flush=True)
    time.sleep(60)
hlr.pipeline.within.draw_within = draw_within
main()
"""


@pytest.fixture
def drawing(started, tmp_path):
    """Start a drawing of a script; return when the script has started its processes."""

    def start(text, *arguments, program=HLR):
        (tmp_path / "part.py").write_text(text)
        (tmp_path / "a.svg").write_text("old")
        process = started(program, "draw", "part.py", "-o", "a.svg", *arguments, stderr=subprocess.PIPE, bufsize=0)
        assert process.stderr.readline() == b"started\n"
        return process

    return start


def said(process, seconds=1.5):
    """What comes on standard error until all who hold it open have ended."""
    pieces, end = [], time.monotonic() + seconds
    while select.select([process.stderr], [], [], max(end - time.monotonic(), 0.0))[0]:
        piece = os.read(process.stderr.fileno(), 4096)
        if not piece:
            return b"".join(pieces).decode()
        pieces.append(piece)
    pytest.fail(f"something still runs after {seconds} s, having said {b''.join(pieces)!r}")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_all_at_once(drawing, number):
    process = drawing(STAYS)
    process.send_signal(number)
    assert said(process) == ""
    assert process.wait(1) == -number


def test_where_orphans_are_not_handed_down_they_are_looked_for_before(drawing):
    process = drawing(STAYS, program=[sys.executable, "-P", "-c", NOT_ADOPTED])
    process.send_signal(signal.SIGTERM)
    assert said(process) == ""
    assert process.wait(1) == -signal.SIGTERM


def test_ctrl_c_on_a_terminal_ends_all_at_once(started, tmp_path):
    fcntl, pty, termios = (pytest.importorskip(name) for name in ("fcntl", "pty", "termios"))
    control, terminal = pty.openpty()
    (tmp_path / "part.py").write_text(STAYS)
    streams = {"stdin": terminal, "stdout": terminal, "stderr": subprocess.PIPE, "bufsize": 0}
    process = started(HLR, "draw", "part.py", **streams, preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
    os.close(terminal)
    assert process.stderr.readline() == b"started\n"
    os.write(control, b"\x03")
    assert said(process) == ""
    assert process.wait(1) == -signal.SIGINT
    os.close(control)


def test_a_script_that_ignores_signals_ends_all_the_same(drawing):
    process = drawing(IGNORES)
    process.send_signal(signal.SIGINT)
    assert said(process, 5.0) == ""
    assert process.wait(1) == -signal.SIGINT


@pytest.mark.parametrize(
    ("last", "words"),
    [
        ("os.abort()", "part.py crashed (abort) in compiled code"),
        ("1 / 0", "ZeroDivisionError"),
        ("os._exit(0)", "part.py ended the program (exit code 0)"),
    ],
)
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nothing is handed down")
def test_where_a_script_fails_what_it_has_started_ends(drawing, last, words):
    process = drawing(SCRIPT + last + "\n")
    assert words in said(process)
    assert process.wait(1) == 2


def test_what_a_script_leaves_running_goes_on_where_it_succeeds(started):
    process = started([sys.executable, "-P", "-c", SUCCEEDS], "draw", "a.step", "-o", "b.svg", stderr=subprocess.PIPE)
    left = int(process.stderr.readline())
    assert process.wait(20) == 0
    os.kill(left, signal.SIGKILL)  # raises where it is gone


def test_processes_of_the_shell_that_became_the_command_are_left_alone(started, tmp_path):
    (tmp_path / "part.py").write_text(STAYS)
    shell = ["sh", "-c", 'sleep 60 2>/dev/null & echo $! && exec "$@"', "sh"]
    process = started([*shell, *HLR], "draw", "part.py", stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0)
    other = int(process.stdout.readline())
    assert process.stderr.readline() == b"started\n"
    process.terminate()
    assert said(process) == ""
    os.kill(other, signal.SIGKILL)


def test_the_last_drawing_is_written_though_its_reader_takes_time(started, tmp_path):
    (tmp_path / "part.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "bufsize": 0}
    process = started(
        [sys.executable, "-P", "-c", DRAWS_ON], "draw", "part.off", "-o", "-", "--within", "1min", **streams
    )
    assert process.stderr.readline() == b"started\n"
    process.send_signal(signal.SIGINT)
    time.sleep(0.5)
    out, _ = process.communicate(timeout=10)
    assert len(out) > 500_000 and out.endswith(b"</svg>\n")
    assert process.returncode == -signal.SIGINT


def test_a_time_limit(drawing, tmp_path):
    begun = time.monotonic()
    process = drawing(STAYS, "--time-limit", "2s")
    assert re.fullmatch(
        r"hlr: part\.py took longer than 2 s and was given up; the script itself ran for (2\.\d|1\.\d) s of that: "
        r"raise --time-limit, or make the script faster\.\n",
        said(process, 5.0),
    )
    assert 2.0 < time.monotonic() - begun < 5.0
    assert process.wait(1) == 2
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.svg", "part.py"]
    assert (tmp_path / "a.svg").read_text() == "old"


def test_a_time_limit_in_json(started, tmp_path):
    (tmp_path / "part.py").write_text("while True: pass\n")
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    process = started(HLR, "draw", "part.py", "--time-limit", "0.5", "--json", **streams)
    out, _ = process.communicate(timeout=10)
    error = json.loads(out)["error"]
    assert (error["kind"], error["exit_code"], process.returncode) == ("SourceError", 2, 2)
    assert error["message"].startswith("part.py took longer than 0.5 s")


def test_what_ends_within_its_time_limit_is_drawn(child, tmp_path):
    assert child("draw", "a.step", "-o", "a.svg", "--time-limit", "1min").wait(20) == 0
    assert (tmp_path / "a.svg").read_bytes().endswith(b"</svg>\n")


def test_a_time_limit_is_refused_where_there_is_no_process_to_end(hlr_command, tmp_path):
    result = hlr_command("draw", "a.step", "-o", "a.svg", "--time-limit", "5s")
    assert (result.code, result.out) == (2, "")
    assert result.err == "hlr: --time-limit needs a process that hlr can end, and there is none here: leave it out.\n"
    assert list(tmp_path.iterdir()) == []
