import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

posix = pytest.mark.skipif(os.name != "posix", reason="signals as in POSIX")


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("bug.step", "internal error: ZeroDivisionError: division by zero"),
        ("panic.step", "internal error in the kernel at visibility/src/scan/sweep.rs:7: index out of bounds"),
    ],
)
def test_a_fault_of_ours_asks_for_a_report(hlr_command, source, words, tmp_path):
    result = hlr_command("draw", source)
    assert result.code == 70
    assert result.err.startswith(f"hlr: {words}; this is a fault of hlr, please report it")
    assert result.err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("source", "code"), [("bug.step", 70), ("missing.step", 2)])
def test_the_traceback_is_there_for_those_who_ask(hlr_command, monkeypatch, source, code):
    monkeypatch.setenv("HLR_DEBUG", "1")
    result = hlr_command("draw", source)
    assert result.code == code
    assert "Traceback" in result.err
    assert result.err.splitlines()[-1].startswith("hlr: ")


def test_out_of_memory_is_said(hlr_command):
    result = hlr_command("draw", "memory.step")
    assert (result.code, result.err) == (2, "hlr: out of memory; a larger --accuracy needs less.\n")


def test_an_unknown_verb(hlr_command):
    result = hlr_command("drow")
    assert result.code == 2
    assert result.err == "hlr: no such command 'drow': did you mean draw? (see hlr --help).\n"
    assert hlr_command("xyz").err == "hlr: no such command 'xyz' (see hlr --help).\n"


@pytest.mark.parametrize(
    ("said", "sentence"),
    [
        ("No such option '--scal'. Did you mean '--scale'?", "no such option '--scal': did you mean '--scale'?"),
        ("No such command 'clea'. (Did you mean 'clear'?)", "no such command 'clea': did you mean 'clear'?"),
        (
            "No such option '--fil'. (Did you mean one of: '--fill', '--fit', '--fov'?)",
            "no such option '--fil': did you mean '--fill', '--fit' or '--fov'?",
        ),
        ("No such option '--xyz'.", "no such option '--xyz'"),
    ],
)
def test_an_unknown_option_is_told_in_one_sentence(said, sentence):
    from hlr.cli.exits import _sentence

    assert _sentence(said) == sentence


@pytest.mark.parametrize("verb", ["draw", "preview"])
def test_strict_says_why_nothing_is_there(hlr_real, tmp_path, verb):
    (tmp_path / "part.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    result = hlr_real(verb, "part.off", "--strict")
    assert (result.code, result.out) == (2, "")
    assert result.err == (
        'hlr: Part "part" is drawn as it is: open: 3 border edges; nothing is written, because of --strict.\n'
    )
    assert [path.name for path in tmp_path.iterdir()] == ["part.off"]


@pytest.mark.parametrize("arguments", [["--help"], ["-h"], ["draw", "--help"], ["info", "-h"], ["--version"]])
def test_help_and_version(hlr_command, arguments):
    result = hlr_command(*arguments)
    assert result.code == 0
    assert result.out.startswith("hlr 0." if arguments == ["--version"] else "Usage: hlr")
    assert result.err == ""


@pytest.mark.parametrize("verb", ["draw", "plan", "preview"])
def test_help_lists_all_named_views(hlr_command, verb):
    from hlr.request.directions import NAMED

    shown = " ".join(hlr_command(verb, "--help").out.split())
    assert f"{', '.join(NAMED)}, or a direction toward the viewer." in shown


def test_every_verb_is_listed_and_there(hlr_command):
    shown = hlr_command("--help").out
    for verb in sorted(path.stem for path in (ROOT / "cli" / "commands").glob("[a-z]*.py")):
        assert re.search(rf"^  {verb}  +[A-Z].*\.$", shown, re.MULTILINE), verb


def test_no_arguments_show_the_help(hlr_command):
    result = hlr_command()
    assert result.code == 2
    assert result.err.startswith("Usage: hlr")


def test_as_a_module(tmp_path):
    shown = subprocess.check_output([sys.executable, "-P", "-m", "hlr", "--help"], cwd=tmp_path, text=True)
    assert shown.startswith("Usage: hlr ")


@posix
def test_ctrl_c_ends_the_process_at_once_while_the_interpreter_is_held(child, tmp_path):
    process = child("draw", "forever.step", "-o", "a.svg", stderr=subprocess.PIPE)
    assert process.stderr.readline() == b"computing\n"
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=3) == -signal.SIGINT
    assert process.stderr.read() == b""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_while_writing_leaves_no_partial_file(slow_writer, tmp_path, number):
    # A suite under nohup hands down an ignored hang-up, which the command rightly keeps.
    process = slow_writer(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL))
    assert len(list(tmp_path.iterdir())) == 2
    process.send_signal(number)
    assert process.wait(timeout=2) == -number
    assert process.stderr.read() == b""
    assert [path.name for path in tmp_path.iterdir()] == ["a.svg"]
    assert (tmp_path / "a.svg").read_text() == "old"


def _deaf():
    """As a shell starts a job in the background, and worse."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGCHLD):
        signal.signal(number, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT, signal.SIGTERM])


@pytest.mark.slow
@posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_inherited_deafness_does_not_matter(child, number):
    process = child("draw", "forever.step", stderr=subprocess.PIPE, preexec_fn=_deaf)
    assert process.stderr.readline() == b"computing\n"
    process.send_signal(number)
    assert process.wait(timeout=3) == -number
    assert process.stderr.read() == b""


@posix
def test_who_ignores_his_children_gets_his_drawing(child, tmp_path):
    assert child("draw", "a.step", "-o", "a.svg", preexec_fn=_deaf).wait(timeout=20) == 0
    assert (tmp_path / "a.svg").exists()


@posix
def test_a_hang_up_that_nohup_ignores_stays_ignored(child):
    def nohup():
        signal.signal(signal.SIGHUP, signal.SIG_IGN)

    process = child("draw", "forever.step", stderr=subprocess.PIPE, preexec_fn=nohup)
    assert process.stderr.readline() == b"computing\n"
    process.send_signal(signal.SIGHUP)
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(timeout=0.5)


@pytest.mark.slow
@posix
def test_a_reader_that_goes_away_is_no_error(child):
    process = child("draw", "large.step", "-o", "-", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.read(10)
    process.stdout.close()
    assert process.wait(timeout=20) == -signal.SIGPIPE
    assert process.stderr.read() == b""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_a_full_standard_output_is_said(child):
    with open("/dev/full", "wb") as full:
        process = child("draw", "a.step", "-o", "-", stdout=full, stderr=subprocess.PIPE)
        assert process.wait(timeout=20) == 2
    assert process.stderr.read() == b"hlr: cannot write to standard output: no space left on device.\n"


PRINTING = [["--help"], ["draw", "--help"], ["--version"], ["cache", "info"], ["cache", "info", "--json"]]
"""What is printed as text, not written as a result."""


def ended(command, output):
    return subprocess.run(command, check=False, stdout=output, stderr=subprocess.PIPE, timeout=20)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.parametrize("arguments", PRINTING)
def test_text_for_a_full_standard_output_is_an_error(arguments):
    with open("/dev/full", "wb") as full:
        done = ended([sys.executable, "-P", "-m", "hlr", *arguments], full)
    assert done.stderr == b"hlr: cannot write to standard output: no space left on device.\n"
    assert done.returncode == 2


@posix
@pytest.mark.parametrize("arguments", PRINTING)
def test_text_that_nobody_reads_is_no_error(arguments):
    reading, writing = os.pipe()
    os.close(reading)
    done = ended([sys.executable, "-P", "-m", "hlr", *arguments], writing)
    os.close(writing)
    assert (done.returncode, done.stderr) == (-signal.SIGPIPE, b"")


@posix
def test_a_closed_standard_output_is_said(child):
    process = child("draw", "a.step", "-o", "-", stderr=subprocess.PIPE, preexec_fn=lambda: os.close(1))
    assert process.wait(timeout=20) == 2
    assert process.stderr.read() == b"hlr: cannot write to standard output: it is closed.\n"


@pytest.mark.parametrize(
    ("arguments", "code", "kind", "words"),
    [
        (["draw", "missing.step", "--json"], 2, "SourceError", "there is no such file."),
        (["info", "missing.step", "--json"], 2, "SourceError", "there is no such file."),
        (["plan", "missing.step", "--json"], 2, "SourceError", "missing.step does not exist"),
        (["draw", "a.step", "--json", "--scale", "0"], 2, "UsageError", "is not a scale"),
        (["draw", "a.step", "--json", "-o", "a.dwg"], 2, "WriteError", "use .svg, .pdf, "),
        (["draw", "bug.step", "--json"], 70, "ZeroDivisionError", "division by zero"),
        (["draw", "memory.step", "--json"], 2, "MemoryError", "out of memory"),
        (["draw", "notes.step", "--json", "--strict"], 2, "StrictError", "because of --strict."),
    ],
)
def test_where_json_was_asked_for_errors_are_json_too(hlr_command, arguments, code, kind, words):
    result = hlr_command(*arguments)
    assert result.code == code
    document = json.loads(result.out)
    found = document.pop("error")
    assert document == {"format": "hlr-error", "version": 1}
    assert (found["kind"], found["exit_code"]) == (kind, code)
    assert words in found["message"]
    assert result.err == f"hlr: {found['message']}\n"


@posix
def test_a_crash_is_json_too(child):
    process = child("draw", "crash.step", "--json", stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    out, _ = process.communicate(timeout=30)
    assert process.returncode == 70
    assert json.loads(out)["error"]["kind"] == "CrashError"


def test_every_message_is_a_sentence(hlr_command):
    """The end of a sentence, but only one."""
    for arguments in (
        ["draw"],
        ["drow"],
        ["draw", "missing.step"],
        ["draw", "memory.step"],
        ["draw", "--fit", "x", "a.step"],
    ):
        err = hlr_command(*arguments).err
        assert err.endswith(".\n") and not err.endswith("..\n"), err


@pytest.mark.parametrize(
    ("option", "end"),
    [
        ("--nix", "no such option '--nix' (see hlr draw --help).\n"),
        (
            "--hiden",
            "no such option '--hiden': did you mean '--hidden', '--hide' or '--no-hidden'? (see hlr draw --help).\n",
        ),
        ("--perspectve", "no such option '--perspectve': did you mean '--perspective'? (see hlr draw --help).\n"),
    ],
)
def test_only_options_that_are_spelled_nearly_so_are_proposed(hlr_command, option, end):
    assert hlr_command("draw", "part.step", option).err == f"hlr: {end}"
