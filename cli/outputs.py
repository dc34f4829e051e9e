"""Names of the output files: {stem}, {view} and {n} stand for the source, the view and its number."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import click

from hlr.drawing.originals import SOURCE, Originals
from hlr.errors import OptionError, SourceError

FIELDS = ("stem", "view", "n")
STDOUT = "-"


@dataclass(frozen=True, slots=True)
class Target:
    """An output file and its format. path: None for standard output. folder: made if it does not exist."""

    path: Path | None
    format: str
    folder: Path | None = None

    @property
    def name(self) -> str:
        """The last part of the path."""
        return "" if self.path is None else self.path.name

    def __str__(self) -> str:
        return "standard output" if self.path is None else str(self.path)


def is_folder(pattern: str) -> bool:
    """Whether an output names a folder: by a slash at its end, or because it is one."""
    return pattern.endswith(("/", os.sep)) or os.path.isdir(pattern)


def plan(pattern: str | None, source: str, views: Sequence[str], ending: str) -> list[Path]:
    """One path per view.

    pattern None: the source's name, in the current folder; a folder: the source's name and the view's, in it. Both get
    the ending. Raises OptionError where two views would have the same file, or a field is unknown; SourceError for a
    source that is a folder, or has no name.
    """
    if not source:
        raise SourceError("the name of the source is empty: name a model file")
    if os.path.isdir(source):  # "." has no stem to name an output after
        raise SourceError(f"{source} is a folder: name a model file in it")
    if pattern is None:
        pattern = ("{stem}-{view}." if len(views) > 1 else "{stem}.") + ending
    elif is_folder(pattern):
        pattern = os.path.join(pattern, "{stem}-{view}." + ending)
    unknown = [field for field in re.findall(r"\{([^{}]*)\}", pattern) if field not in FIELDS]
    if unknown:
        raise OptionError(f"the output name has the unknown field {{{unknown[0]}}}; use {{stem}}, {{view}} or {{n}}")
    paths = [_fill(pattern, Path(source).stem, view, i + 1) for i, view in enumerate(views)]
    if len(set(paths)) < len(paths):
        if "{view}" not in pattern:
            raise OptionError(
                f"{len(views)} views cannot share the one file {pattern}; put {{view}} into its name, "
                f"for example {_example(pattern)}"
            )
        twice = next(path for i, path in enumerate(paths) if path in paths[:i])
        raise OptionError(f"two views would be written to {twice}; name each view once, or put {{n}} into the name")
    return paths


READ = {
    "source": SOURCE,
    "before": SOURCE,
    "after": SOURCE,
    "template": "the template",
    "style": "the style",
}
"""Arguments and options of all commands that name a file which is read, and what it is called."""


def check(targets: Sequence[Target]) -> None:
    """Refuse outputs that cannot be written, before any work is done.

    Raises OptionError where two outputs are the same file, however it is spelled, be it only on file systems that take
    large and small letters for the same; WriteError for a missing folder, a lack of permission, a file that the
    command reads, or another model.
    """
    from hlr.drawing import files

    paths = [(target.path, target.folder is not None) for target in targets if target.path is not None]
    found: dict[str, Path] = {}
    for path, _ in paths:
        real = os.path.realpath(path)
        same = found.setdefault(real.casefold(), path)
        if same is not path:
            if os.path.realpath(same) != real:
                raise OptionError(
                    f"{same} and {path} are one file where large and small letters are the same, as on Windows and "
                    "macOS; give each a name of its own"
                )
            also = "" if same == path else f", which is {same}"
            raise OptionError(f"two things would be written to {path}{also}; give each a name of its own")
    Originals(_read()).check(path for path, _ in paths)
    for path, make_folder in paths:
        files.check_writable(path, make_folder)


def _read() -> Iterator[tuple[Path, str]]:
    """The files that the command's arguments and options name, and what each is called."""
    from hlr.request.style_file import file_of

    context = click.get_current_context(silent=True)
    given = {} if context is None else context.params
    for name, what in READ.items():
        path = None if not given.get(name) else file_of(given[name]) if name == "style" else Path(given[name])
        if path is not None:
            yield path, what


def in_folder(folder: str, names: Sequence[str]) -> list[Target]:
    """Files of these names in a folder, which is made if it does not exist.

    Raises WriteError where they cannot be written there.
    """
    found = [Target(Path(folder, name), name.rpartition(".")[2], Path(folder)) for name in names]
    check(found)
    return found


def place(made: Sequence[tuple[Target, bytes]]) -> None:
    """Write all files or none."""
    from hlr.drawing import files

    from .signals import tidily

    with tidily():
        files.write_all(
            {target.path: data for target, data in made if target.path is not None},
            dict.fromkeys(target.folder for target, _ in made if target.folder is not None),
        )


def _fill(pattern: str, stem: str, view: str, n: int) -> Path:
    fields = {"stem": stem, "view": re.sub(r"[^\w.+-]", "_", view), "n": str(n)}
    return Path(re.sub(r"\{(\w+)\}", lambda match: fields[match[1]], pattern))


def _example(pattern: str) -> str:
    path = Path(pattern)
    return str(path.with_name(f"{path.stem}-{{view}}{path.suffix}"))
