"""`hlr cache`: show the cache of models, or clear it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from hlr.cache.store import DRAWINGS
from hlr.errors import counted
from hlr.tables.readers import file_titles

from ..streams import show

if TYPE_CHECKING:
    from hlr.cache.store import Kept, Store


_FILES = file_titles(lambda reader: reader.cached)

_HELP = f"""The cache of {_FILES} files that were read before, so that they need not be read again, and of what
batches have drawn.

\b
  HLR_CACHE=DIR        the folder, instead of the system's usual one for caches
  HLR_CACHE=off        no cache; --no-cache does so for one command
  HLR_CACHE_SIZE=1GB   its largest size; the least recently used models are removed first
"""


@click.group(help=_HELP)
def cache() -> None:
    """The cache of models."""


@cache.command()
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def info(as_json: bool) -> None:
    """Show where the cache is, and how large."""
    store = _store()
    entries = [] if store is None else store.entries()
    size = sum(kept.size for kept in entries)
    models, drawn = _counted(entries)
    if as_json:
        import json

        from hlr.tables.documents import head

        folder = None if store is None else str(store.folder)
        most = None if store is None else store.most
        found = {"folder": folder, "models": models, "drawn": drawn, "bytes": size, "most_bytes": most}
        show(*json.dumps(head("hlr-cache") | found, indent=2).split("\n"))
    elif store is None:
        show(_OFF)
    else:
        show(f"{store.folder}: {_told(entries)}, {_mega(size)} of at most {_mega(store.most)}")


@cache.command(short_help="Remove all models and drawings from the cache.")
def clear() -> None:
    """Remove all models and drawings from the cache; other files in its folder stay."""
    from hlr.errors import WriteError

    store = _store()
    if store is None:
        show(_OFF)
        return
    try:
        gone = store.clear()
    except OSError as error:
        raise WriteError(f"{store.folder} cannot be cleared: {(error.strerror or str(error)).lower()}") from None
    show(f"{store.folder}: {_told(gone)} removed, {_mega(sum(kept.size for kept in gone))}")


_OFF = "The cache is off (HLR_CACHE)."


def _store() -> Store | None:
    from hlr.cache.folder import folder, most_bytes
    from hlr.cache.store import Store

    where = folder()
    return None if where is None else Store(where, most_bytes())


def _counted(entries: Sequence[Kept]) -> tuple[int, int]:
    """How many entries are models that were read, and how many are what a batch has drawn of a source."""
    drawn = sum(DRAWINGS in kept.path.name for kept in entries)
    return len(entries) - drawn, drawn


def _told(entries: Sequence[Kept]) -> str:
    models, drawn = _counted(entries)
    return counted(models, "model") + (f" and {counted(drawn, 'drawn source')}" if drawn else "")


def _mega(size: int) -> str:
    return f"{size / 1e6:,.1f} MB"
