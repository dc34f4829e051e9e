import re
import signal

import pytest


@pytest.mark.slow
def test_a_long_job_shows_its_stage_and_then_clears_it(on_terminal):
    shown, code = on_terminal("draw", "slow.step", "-o", "a.svg")
    assert code == 0
    assert "visibility" in shown
    # The line is erased and the cursor shown again before the summary.
    bar, summary = shown.rsplit("\x1b[2K", 1)
    assert bar.count("\x1b[?25h") == bar.count("\x1b[?25l") > 0
    assert re.fullmatch(r"a\.svg: iso, 1:1, 6 visible and 4 hidden lines, [\d.]+ s\r\n", summary)


@pytest.mark.slow
def test_a_short_job_shows_only_what_was_written(on_terminal):
    shown, code = on_terminal("draw", "a.step", "-o", "a.svg")
    assert code == 0
    assert re.fullmatch(r"a\.svg: .* lines, [\d.]+ s\r\n", shown)


@pytest.mark.slow
def test_quiet(on_terminal):
    assert on_terminal("draw", "slow.step", "-o", "a.svg", "--quiet") == ("", 0)


def test_a_pipe_sees_no_progress(hlr_command):
    assert hlr_command("draw", "prints.step").err == "printed by a script\nprinted by a library\n"


def test_ctrl_c_gives_the_cursor_back(on_terminal):
    shown, code = on_terminal("draw", "forever.step", "-o", "a.svg", interrupt="source")
    assert code == -signal.SIGINT
    assert shown.count("\x1b[?25h") == shown.count("\x1b[?25l") > 0
    assert "Traceback" not in shown


@pytest.mark.slow
def test_a_time_limit_gives_the_cursor_back_before_its_sentence(on_terminal):
    shown, code = on_terminal("draw", "slow.step", "-o", "a.svg", "--time-limit", "2s", columns=200)
    assert code == 2
    bar, sentence = shown.rsplit("\x1b[2K", 1)
    assert bar.count("\x1b[?25h") == bar.count("\x1b[?25l") > 0
    assert sentence.startswith("hlr: slow.step took longer than 2 s")
