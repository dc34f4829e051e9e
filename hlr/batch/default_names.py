"""How the files of a source are called by default, where other sources have nearly the same name."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


def stems(sources: Iterable[Path]) -> dict[Path, str]:
    """What stands for {stem} in the default name of each source.

    It is {stem}. Where sources differ in their ending only, it is {stem}.{ending}. Where they differ in nothing but
    large and small letters, which are the same to many file systems, all but the first get a number.
    """
    paths = sorted(set(sources))
    alike: dict[str, list[Path]] = {}
    for path in paths:
        alike.setdefault(_folded(path.with_suffix("")), []).append(path)
    found: dict[Path, str] = {}
    for group in alike.values():
        ending = ".{ending}" if len({_folded(path) for path in group}) > 1 else ""
        count: dict[str, int] = {}
        for path in group:
            same = _folded(path)
            count[same] = number = count.get(same, 0) + 1
            while number > 1 and _folded(path.with_name(f"{path.stem}-{number}")) in alike:
                number += 1
            found[path] = f"{{stem}}{f'-{number}' if number > 1 else ''}{ending}"
            count[same] = number
    return found


def _folded(path: Path) -> str:
    """A path as a file system sees it that takes large and small letters for the same."""
    return str(path).casefold()
