"""Names of the output files: {stem}, {view} and {n} stand for the source, the view and its number."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from hlr.errors import OptionError

FIELDS = ("stem", "view", "n")
STDOUT = "-"


def plan(pattern: str | None, source: str, views: Sequence[str], format: str | None) -> list[Path]:
    """One path per view.

    pattern None: the source's name with the ending of the format, in the current folder. Raises OptionError where
    two views would have the same file, or a field is unknown.
    """
    if pattern is None:
        pattern = ("{stem}-{view}." if len(views) > 1 else "{stem}.") + (format or "svg")
    unknown = [field for field in re.findall(r"\{(\w*)\}", pattern) if field not in FIELDS]
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


def _fill(pattern: str, stem: str, view: str, n: int) -> Path:
    fields = {"stem": stem, "view": re.sub(r"[^\w.+-]", "_", view), "n": str(n)}
    return Path(re.sub(r"\{(\w+)\}", lambda match: fields[match[1]], pattern))


def _example(pattern: str) -> str:
    path = Path(pattern)
    return str(path.with_name(f"{path.stem}-{{view}}{path.suffix}"))
