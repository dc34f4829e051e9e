"""A crash of the worker is an error; and but for that, nobody notices that there is a worker."""

import os
import re
import select
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

from support import fake_pipeline as fake

if not hasattr(os, "fork"):
    pytest.skip("there is no worker without fork", allow_module_level=True)

# The command line, with a reader that does what {} says.
PATCHED = """
import ctypes, os, signal, sys
import hlr.source.cad.step
def reader(path, annotations=False):
    {body}
hlr.source.cad.step.open_step = reader
from hlr.cli import main
main()
"""
OLD = b"old"


def finished(process, seconds=30.0):
    out, err = process.communicate(timeout=seconds)
    return process.returncode, out, err.decode()


@pytest.fixture
def patched(tmp_path):
    """The command line as a process of its own, with another reader of STEP files."""

    def start(body, *arguments, **options):
        program = PATCHED.format(body=body)
        (tmp_path / "part.step").write_bytes(b"ISO-10303-21;")
        (tmp_path / "a.svg").write_bytes(OLD)
        command = [sys.executable, "-P", "-c", program, *(arguments or ("draw", "part.step", "-o", "a.svg"))]
        return subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    return start


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("ctypes.string_at(0)", "segmentation fault"),
        ("os.abort()", "abort"),
        ("os.kill(os.getpid(), signal.SIGBUS)", "bus error"),
        ("os.kill(os.getpid(), signal.SIGILL)", "illegal instruction"),
        ("os.kill(os.getpid(), signal.SIGFPE)", "arithmetic error"),
    ],
)
@pytest.mark.parametrize("verb", ["draw", "info"])
def test_a_reader_that_crashes(patched, tmp_path, verb, body, reason):
    arguments = ("draw", "part.step", "-o", "a.svg") if verb == "draw" else ("info", "part.step")
    code, out, err = finished(patched(body, *arguments))
    assert (code, out) == (2, b"")
    assert err == (
        f"hlr: part.step crashed OpenCASCADE ({reason}) while it was read; nothing was written; the file is probably "
        "broken: export it again, or in another format.\n"
    )
    assert (tmp_path / "a.svg").read_bytes() == OLD
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.svg", "part.step"]


def test_a_section_that_crashes(tmp_path):
    program = (
        "import ctypes, hlr.source.cad.half_space as cutter; cutter.cut_away = lambda *_: ctypes.string_at(0)\n"
        "from hlr.pipeline.section import sources; from hlr.source.cad.kernel_cut import KernelCut\n"
        "sources.KernelCut = lambda *asked: KernelCut(*asked[:3], ())\n"
        "from hlr.cli import main; main()"
    )
    model = Path(__file__).parents[1] / "data" / "freecad" / "box.step"
    command = [sys.executable, "-P", "-c", program, "draw", model, "--section", "front", "-o", "a.svg"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.startswith("hlr: box.step crashed OpenCASCADE (segmentation fault) while it was cut; nothing")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_full_stack(patched):
    body = "f = ctypes.PYFUNCTYPE(None)(lambda: f()); sys.setrecursionlimit(10**9); f()"
    code, out, err = finished(patched(body))
    assert (code, out) == (2, b"")
    assert err.startswith("hlr: part.step crashed OpenCASCADE (segmentation fault)")


def test_killed_for_want_of_memory(patched, tmp_path):
    code, _, err = finished(patched("os.kill(os.getpid(), signal.SIGKILL)"))
    assert code == 2
    assert err == "hlr: part.step: the work was killed, most likely for want of memory; nothing was written.\n"
    assert (tmp_path / "a.svg").read_bytes() == OLD


@pytest.mark.slow
@pytest.mark.parametrize("body", ["import ctypes; ctypes.string_at(0)", "import os; os.abort()"])
def test_a_script_that_crashes(tmp_path, body):
    (tmp_path / "part.py").write_text(body)
    (tmp_path / "a.svg").write_bytes(OLD)
    command = [sys.executable, "-P", "-m", "hlr", "draw", "part.py", "-o", "a.svg"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert re.fullmatch(
        r"hlr: part\.py crashed \((segmentation fault|abort)\) in compiled code that it uses; nothing was written\.\n",
        done.stderr,
    )
    assert (tmp_path / "a.svg").read_bytes() == OLD


def test_a_crash_of_our_own_code_asks_for_a_report(child, tmp_path):
    process = child("draw", "crash.step", "-o", "a.svg", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    code, out, err = finished(process)
    assert (code, out) == (70, b"")
    assert err.startswith(
        "hlr: internal error: CrashError: segmentation fault while drawing crash.step; nothing was wr"
    )
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_crash_after_all_was_written_is_none(child, tmp_path):
    process = child("draw", "crash-late.step", "-o", "a.svg", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert finished(process) == (0, b"", "")
    assert (tmp_path / "a.svg").read_bytes().endswith(b"</svg>\n")


@pytest.mark.slow
def test_the_progress_bar_is_gone_before_the_sentence(on_terminal):
    shown, code = on_terminal("draw", "crash-slowly.step", columns=200)
    assert code == 70
    bar, sentence = shown.rsplit("\x1b[2K", 1)
    assert "visibility" in bar
    assert bar.count("\x1b[?25h") == bar.count("\x1b[?25l") > 0
    assert sentence.startswith("hlr: internal error: CrashError")
    assert sentence.count("\n") == 1


@pytest.mark.slow
def test_exit_codes_and_output_pass_through(child, tmp_path):
    def run(*arguments):
        return finished(child(*arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE))

    code, out, err = run("draw", "a.step", "-o", "-")
    assert (code, out[:5], err) == (0, b"<?xml", "")
    assert run("draw", "missing.step")[::2] == (2, "hlr: cannot read missing.step: there is no such file.\n")
    assert run("draw", "bug.step")[0] == 70
    assert run("draw", "a.step", "--nonsense")[0] == 2


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_whatever_ends_the_command_ends_the_worker(child, number):
    process = child("draw", "forever.step", stderr=subprocess.PIPE)
    assert process.stderr.readline() == b"computing\n"
    process.send_signal(number)
    assert process.wait(timeout=3) == -number
    # The worker held standard error open: it has ended when this returns.
    assert select.select([process.stderr], [], [], 3)[0]
    assert process.stderr.read() == b""


# A program that starts the command, says so, and waits to be killed.
PARENT = """
import signal, subprocess, sys, time
if sys.argv[1] == "nohup":
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
subprocess.Popen(sys.argv[2:])
time.sleep(60)
"""


@pytest.mark.slow
@pytest.mark.parametrize("how", ["plain", "nohup"])
def test_the_command_ends_with_its_parent_but_for_nohup(started, how):
    parent = started(
        [sys.executable, "-P", "-c", PARENT, how],
        *fake.PROGRAM,
        "draw",
        "forever.step",
        stderr=subprocess.PIPE,
    )
    assert parent.stderr.readline() == b"computing\n"
    parent.kill()
    # Both processes of the command hold standard error open: it is at its end when they have ended.
    over = select.select([parent.stderr], [], [], 5.0 if how == "plain" else 1.0)[0]
    assert bool(over) == (how == "plain")
    if over:
        assert parent.stderr.read() == b""


@pytest.mark.slow
@pytest.mark.parametrize("code", [0, 7])
def test_a_script_that_leaves_is_refused(started, tmp_path, code):
    (tmp_path / "part.py").write_text(f"import os\nos._exit({code})\n")
    process = started(
        [sys.executable, "-P", "-m", "hlr"],
        "draw",
        "part.py",
        "-o",
        "a.svg",
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert finished(process) == (
        2,
        b"",
        f"hlr: part.py ended the program (exit code {code}) before anything was drawn; nothing was written; "
        "take os._exit out of it.\n",
    )
    assert [path.name for path in tmp_path.iterdir()] == ["part.py"]


@pytest.mark.slow
@pytest.mark.skipif(find_spec("cadquery") is None, reason="the script is one of CadQuery")
def test_a_script_may_do_at_exit_what_it_likes(started, tmp_path):
    (tmp_path / "part.py").write_text(
        "import atexit, os\nimport cadquery as cq\nresult = cq.Workplane().box(1, 1, 1)\natexit.register(os._exit, 7)\n"
    )
    process = started([sys.executable, "-P", "-m", "hlr"], "draw", "part.py", "-o", "a.svg", "-q")
    assert process.wait(60) == 0
    assert (tmp_path / "a.svg").exists()


@pytest.mark.slow
def test_no_core_file_is_left(patched, tmp_path):
    import resource

    def wants_cores():
        resource.setrlimit(resource.RLIMIT_CORE, (resource.getrlimit(resource.RLIMIT_CORE)[1],) * 2)

    assert finished(patched("ctypes.string_at(0)", preexec_fn=wants_cores))[0] == 2
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.svg", "part.step"]


@pytest.mark.slow
def test_those_who_look_for_the_fault_see_where_it_was(patched):
    code, _, err = finished(patched("ctypes.string_at(0)", env=os.environ | {"HLR_DEBUG": "1"}))
    assert code == 2
    assert "Fatal Python error: Segmentation fault" in err
    assert err.splitlines()[-1].startswith("hlr: part.step crashed OpenCASCADE")


def test_another_program_is_not_split(hlr_command, monkeypatch):
    """Called with arguments, the command line is part of somebody's process: forking it could break its threads."""
    monkeypatch.setattr(os, "fork", lambda: pytest.fail("forked"))
    assert hlr_command("draw", "a.step").code == 0


@pytest.mark.slow
def test_help_needs_no_worker(tmp_path):
    program = "import os; os.fork = lambda: 1 / 0\nfrom hlr.cli import main; main()"
    for arguments in (["--help"], ["draw", "--help"], ["draw", "a.step", "-o", "a.dwg"]):
        command = [sys.executable, "-P", "-c", program, *arguments]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
        assert b"ZeroDivisionError" not in done.stderr


def test_two_signals_do_not_disturb_the_tidying(slow_writer, tmp_path):
    """Ctrl-C reaches the worker from the terminal and from the waiting process."""
    process = slow_writer(start_new_session=True)
    for _ in range(3):
        os.killpg(process.pid, signal.SIGINT)
        time.sleep(0.001)
    assert process.wait(timeout=5) == -signal.SIGINT
    assert process.stderr.read() == b""
    assert [path.name for path in tmp_path.iterdir()] == ["a.svg"]
    assert (tmp_path / "a.svg").read_bytes() == OLD
