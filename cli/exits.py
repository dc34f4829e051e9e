"""The end of the command: each error becomes one sentence and an exit code."""

from __future__ import annotations

import contextlib
import gc
import os
import re
import signal
import sys
import warnings
from collections.abc import Sequence
from typing import NoReturn

import click

from hlr.errors import HlrError, KernelError, StrictError
from hlr.tables.entry import listed

from . import guard, signals
from .streams import ReaderGoneError, printing, say, show

REFUSED = 2
FAULT = 70
"""EX_SOFTWARE of sysexits.h: 1 says that drawings differ, or that some sources of a batch failed."""


def run(command: click.Command, arguments: Sequence[str] | None = None) -> NoReturn:
    """Run a command and end the process with its exit code."""
    signals.at_once(own=arguments is None)
    _Asked.json = "--json" in (sys.argv[1:] if arguments is None else arguments)
    # Huge coordinates overflow on their way to an error or a drawing: NumPy's own warnings do not help the user.
    warnings.filterwarnings("ignore", category=RuntimeWarning, module=r"(hlr|numpy|trimesh)\b")
    try:
        with printing():
            result = command.main(args=arguments, prog_name="hlr", standalone_mode=False)
        _leave(result if isinstance(result, int) else 0)
    except click.exceptions.NoArgsIsHelpError as error:
        say(*error.format_message().split("\n"))
        _leave(REFUSED)
    except click.UsageError as error:
        path = error.ctx.command_path if error.ctx else "hlr"
        _refuse(f"{_sentence(error.format_message())} (see {path} --help)", "UsageError")
    except click.ClickException as error:
        _refuse(error.format_message(), "UsageError")
    except KernelError as error:
        _debug()
        _refuse(str(error), "KernelError", FAULT)
    except HlrError as error:
        _debug()
        _refuse(_message(error), type(error).__name__)
    except signals.Stopped as stopped:
        signals.die_by(stopped.number)
    except (KeyboardInterrupt, click.Abort):
        signals.die_by(signal.SIGINT)
    except ReaderGoneError:
        _broken_pipe()
    except MemoryError:
        _debug()
        _refuse("out of memory; a larger --accuracy needs less", "MemoryError")
    except SystemExit:
        raise
    except BaseException as error:
        _debug()
        _report(error)


def warn(message: str) -> None:
    """Print a warning to standard error."""
    say(f"hlr: warning: {_full(message)}")


def remark(message: str) -> None:
    """Print a note to standard error: worth knowing, but no warning."""
    say(f"hlr: note: {_full(message)}")


def _refuse(message: str, kind: str, code: int = REFUSED) -> NoReturn:
    """Print one sentence to standard error, and with --json the same as JSON to standard output; then end."""
    text = _full(message)
    say(f"hlr: {text}")
    if _Asked.json and sys.stdout is not None:
        import json

        from hlr.tables.documents import head

        document = head("hlr-error") | {"error": {"kind": kind, "message": text, "exit_code": code}}
        with contextlib.suppress(HlrError, ReaderGoneError):
            show(*json.dumps(document, indent=2).split("\n"))
    _leave(code)


class _Asked:
    """Whether --json is among the arguments, known before they are parsed: errors may come earlier."""

    json = False


def _report(error: BaseException) -> NoReturn:
    text = _one_line(str(error)) or "no message"
    kind = type(error).__name__
    _refuse(
        f"internal error: {kind}: {text}; this is a fault of hlr, please report it with the command and, if you may "
        "share it, the model (HLR_DEBUG=1 shows the traceback)",
        kind,
        FAULT,
    )


def _debug() -> None:
    """Show the traceback of the current exception where it was asked for."""
    if os.environ.get("HLR_DEBUG", "") not in ("", "0"):
        import traceback

        say(*traceback.format_exc().rstrip("\n").split("\n"))


def _broken_pipe() -> NoReturn:
    """End silently when nobody reads the output any more, as other programs do."""
    if hasattr(signal, "SIGPIPE"):
        signals.die_by(signal.SIGPIPE)
    os._exit(0)


def _leave(code: int) -> NoReturn:
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except ReaderGoneError:
        _broken_pipe()
    except HlrError:
        # It was said before. Python would try once more to write what is left.
        sys.stdout = None
    guard.note(f"done {code}")
    # The modules of OpenCASCADE hold thousands of objects: searching them for garbage takes half a second.
    gc.freeze()
    sys.exit(code)


def _sentence(message: str) -> str:
    """A message of click in our style: it begins with a small letter and has no full stop."""
    text = message.rstrip(".")
    if near := re.fullmatch(r"(.*)\. \(?Did you mean (?:one of: )?(.*?)\?\)?", text):
        text = f"{near[1]}: did you mean {listed(near[2].split(', '), 'or')}?"
    return text[:1].lower() + text[1:]


def _message(error: HlrError) -> str:
    """What an error says. Where a warning is one, the pipeline says no more than the warning: the reason is added."""
    text, reason = str(error), "nothing is written, because of --strict"
    return text if not isinstance(error, StrictError) or reason in text else f"{text.rstrip('.')}; {reason}"


def _full(message: str) -> str:
    """A message as one line that ends as a sentence does."""
    text = _one_line(message)
    return text if text.endswith((".", "!", "?", "\u2026")) else text + "."


def _one_line(message: str) -> str:
    return " ".join(message.split())
