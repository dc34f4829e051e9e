"""Collections of CAD objects in memory: lists, and dicts whose keys are the names of the parts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, ValuesView
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import Any

from hlr.drawing.notes import Note
from hlr.source.cad.parts import Leaf


def is_collection(thing: Any) -> bool:
    """Whether it is a list, or a dict: what has an order, and can be read more than once."""
    return isinstance(thing, list | tuple | Mapping | ValuesView)


def items_of(thing: Any) -> list[Any]:
    """What is in a list or a dict."""
    return list(thing.values() if isinstance(thing, Mapping) else thing)


def nones_in(thing: Any, where: str = "") -> Iterator[Note]:
    """A warning for each None in a list or a dict. where: the keys and numbers of what this is in."""
    if not is_collection(thing):
        return
    pairs = thing.items() if isinstance(thing, Mapping) else enumerate(thing, 1)
    for key, item in pairs:
        path = f"{where}/{key}" if where else str(key)
        if item is None:
            what = f'Part "{path}"' if isinstance(thing, Mapping) or where else f"Item {key} of the list"
            yield Note("part-left-out", f"{what} is None and was left out.")
        else:
            yield from nones_in(item, path)


def renamed(leaves: list[Leaf], own: str, key: str) -> list[Leaf]:
    """Leaves of what a dict has under a key: those of an assembly are named by their path, key/child.

    own: the name that the object has by itself, or ""; it gives way to the key
    """
    alone = len(leaves) == 1 and not leaves[0].above
    return [replace(leaf, name=key if alone or leaf.name in (own, key) else f"{key}/{leaf.name}") for leaf in leaves]


def why_not_read(thing: Any, is_read: Callable[[Any], bool]) -> str | None:
    """What is wrong with a set, an iterator, a dict, or a list of which some is read; None: it is something else.

    is_read: whether an item can be drawn
    """
    if isinstance(thing, AbstractSet):
        return "it has no order: pass a list, or a dict of names and shapes"
    if isinstance(thing, Iterator):
        return "it can be read only once: pass a list of what it gives"
    items = [] if not is_collection(thing) else [item for item in items_of(thing) if item is not None]
    if not isinstance(thing, Mapping) and not any(map(is_read, items)):
        return None
    if not items:
        return "it holds no shapes"
    bad = next(type(item).__name__ for item in items if not is_read(item))
    return f"{bad} in it is no CAD object, as all that it holds must be"
