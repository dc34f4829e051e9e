import os
import re
import select
import signal
import time

import pytest

pty = pytest.importorskip("pty")


def run(child, *arguments, seconds=20.0, interrupt=None):
    """The command with a terminal as standard error: what it shows there, and its exit code."""
    control, terminal = pty.openpty()
    process = child(
        *arguments, stderr=terminal, start_new_session=True, env=os.environ | {"TERM": "xterm", "COLUMNS": "80"}
    )
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


def test_a_long_job_shows_its_stage_and_then_clears_it(child):
    shown, code = run(child, "draw", "slow.step", "-o", "a.svg")
    assert code == 0
    assert "visibility" in shown
    # The line is erased and the cursor shown again before the summary.
    bar, summary = shown.rsplit("\x1b[2K", 1)
    assert bar.count("\x1b[?25h") == bar.count("\x1b[?25l") > 0
    assert re.fullmatch(r"a\.svg: iso, 1:1, 6 visible and 4 hidden lines, [\d.]+ s\r\n", summary)


def test_a_short_job_shows_only_what_was_written(child):
    shown, code = run(child, "draw", "a.step", "-o", "a.svg")
    assert code == 0
    assert re.fullmatch(r"a\.svg: .* lines, [\d.]+ s\r\n", shown)


def test_quiet(child):
    assert run(child, "draw", "slow.step", "-o", "a.svg", "--quiet") == ("", 0)


def test_a_pipe_sees_no_progress(hlr_command):
    assert hlr_command("draw", "prints.step").err == "printed by a script\nprinted by a library\n"


def test_ctrl_c_gives_the_cursor_back(child):
    shown, code = run(child, "draw", "forever.step", "-o", "a.svg", interrupt="source")
    assert code == -signal.SIGINT
    assert shown.count("\x1b[?25h") == shown.count("\x1b[?25l") > 0
    assert "Traceback" not in shown
