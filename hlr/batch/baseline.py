"""Earlier drawings that a batch is compared with: those of a folder, or of a revision in git.

Names are paths of drawings, seen from the folder of outputs. From git only its lists and contents are read, by commands
that run nothing of the repository's own.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
from collections.abc import Iterable
from pathlib import Path, PurePosixPath
from typing import Protocol

from hlr.batch.plan import Plan
from hlr.errors import OptionError

FOLDER = "baseline"
"""In the folder of outputs: earlier drawings that differ, and overlays."""

GIT = "git:"

_OTHERS = (FOLDER, "page")
"""Folders of a report that hold SVG files which are no drawings of the batch."""

_SECONDS = 120.0
"""For one command of git."""

_NO_SURPRISES = {"GIT_NO_LAZY_FETCH": "1", "GIT_TERMINAL_PROMPT": "0", "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C"}


class Baseline(Protocol):
    """Earlier drawings."""

    def names(self) -> frozenset[str]:
        """Of all SVG files."""

    def same(self, name: str, content: bytes) -> bool | None:
        """Whether a drawing had this content; None: there was none of this name."""

    def read(self, name: str) -> bytes:
        """The content of a drawing. Raises OptionError where it cannot be read."""


def baseline_of(text: str, plan: Plan) -> Baseline:
    """What `--baseline` names: a folder, or git:REVISION of the folder of outputs.

    Raises OptionError where there is no such folder or revision, or where the batch would overwrite it.
    """
    files = (file for job in plan.jobs for row in job.files for file in row)
    taken = next((file for file in files if PurePosixPath(file).parts[0] == FOLDER), None)
    if taken is not None:
        raise OptionError(f"{taken} lies where the baseline's drawings are copied to: choose another name for it")
    if not text:
        raise OptionError("the name of the baseline is empty: name a folder with earlier drawings, or git:REVISION")
    if text.startswith(GIT):
        return GitBaseline(plan.output, text.removeprefix(GIT))
    folder = Path(os.path.abspath(text))
    if not folder.is_dir():
        raise OptionError(f"the baseline {text} is no folder: name one with earlier drawings, or git:REVISION")
    if os.path.realpath(folder) == os.path.realpath(plan.output):
        raise OptionError(f"the baseline {text} is the folder that is written to: name a copy of it, or git:REVISION")
    _check_inside(Path(os.path.realpath(folder)), plan, text)
    return FolderBaseline(folder)


def _check_inside(folder: Path, plan: Plan, text: str) -> None:
    """Raise OptionError where the baseline lies in the folder of outputs, where something is written.

    folder: of the baseline, through links; text: as it was given
    """
    output = Path(os.path.realpath(plan.output))
    if not folder.is_relative_to(output):
        return
    inside = folder.relative_to(output)
    files = (PurePosixPath(file) for job in plan.jobs for row in job.files for file in row)
    if inside.parts[0] == FOLDER or any(file.is_relative_to(inside.as_posix()) for file in files):
        raise OptionError(f"the baseline {text} would be overwritten: copy it out of the folder of outputs first")


class FolderBaseline:
    """Earlier drawings in a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def names(self) -> frozenset[str]:
        """Of all SVG files."""
        return _drawings(path.relative_to(self._folder).as_posix() for path in self._folder.rglob("*.svg"))

    def same(self, name: str, content: bytes) -> bool | None:
        """Whether a drawing had this content."""
        path = self._folder / name
        if not path.is_file():
            return None
        return path.stat().st_size == len(content) and self.read(name) == content

    def read(self, name: str) -> bytes:
        """The content of a drawing."""
        try:
            return (self._folder / name).read_bytes()
        except OSError as error:
            raise OptionError(f"{self._folder / name} cannot be read: {error.strerror}") from None


class GitBaseline:
    """Earlier drawings in a revision of the repository that the folder of outputs lies in."""

    def __init__(self, output: Path, revision: str) -> None:
        self._at = next(folder for folder in (output, *output.parents) if folder.is_dir())
        self._said = f"git:{revision}"
        if not revision or revision.startswith("-") or any(not c.isprintable() for c in revision):
            raise OptionError(f"the baseline {self._said!r} names no revision: give one, such as git:main")
        top = Path(os.fsdecode(self._git("rev-parse", "--show-toplevel").rstrip(b"\n")))
        wanted = f"{revision}^{{commit}}"
        commit = self._git("rev-parse", "--verify", "--quiet", "--end-of-options", wanted).decode("ascii").strip()
        inside = Path(os.path.realpath(output)).relative_to(os.path.realpath(top)).as_posix()
        self._at = top
        self._blobs: dict[str, str] = {}
        where = [] if inside == "." else ["--", f"{inside}/"]
        for entry in self._git("--literal-pathspecs", "ls-tree", "-r", "-z", commit, *where).split(b"\0")[:-1]:
            facts, _, path = entry.partition(b"\t")
            mode, *_, blob = facts.decode("ascii").split(" ")
            if mode in ("100644", "100755"):  # no links: they lead elsewhere
                name = PurePosixPath(os.fsdecode(path))
                self._blobs[(name if inside == "." else name.relative_to(inside)).as_posix()] = blob

    def names(self) -> frozenset[str]:
        """Of all SVG files."""
        return _drawings(name for name in self._blobs if name.endswith(".svg"))

    def same(self, name: str, content: bytes) -> bool | None:
        """Whether a drawing had this content, by git's own name for it: nothing is read."""
        blob = self._blobs.get(name)
        if blob is None:
            return None
        hashed = hashlib.sha1 if len(blob) == 40 else hashlib.sha256
        return hashed(b"blob %d\0" % len(content) + content).hexdigest() == blob

    def read(self, name: str) -> bytes:
        """The content of a drawing."""
        return self._git("cat-file", "blob", self._blobs[name])

    def _git(self, *arguments: str) -> bytes:
        command = ["git", "-C", str(self._at), *arguments]
        try:
            done = subprocess.run(
                command, check=True, stdin=subprocess.DEVNULL, capture_output=True, timeout=_SECONDS,
                env=os.environ | _NO_SURPRISES,
            )  # fmt: skip
        except FileNotFoundError:
            raise OptionError(f"the baseline {self._said} needs git, which is not installed") from None
        except subprocess.TimeoutExpired:
            raise OptionError(f"the baseline {self._said} cannot be read: git takes too long") from None
        except subprocess.CalledProcessError as error:
            told = os.fsdecode(error.stderr).strip().removeprefix("fatal: ") or "there is no such revision"
            raise OptionError(f"the baseline {self._said} cannot be read in {self._at}: {told}") from None
        return done.stdout


def _drawings(names: Iterable[str]) -> frozenset[str]:
    return frozenset(name for name in names if PurePosixPath(name).parts[0] not in _OTHERS)
