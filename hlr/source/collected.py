"""Collections of CAD objects or meshes in memory: lists, and dicts whose keys are the names of the parts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, ValuesView
from collections.abc import Set as AbstractSet
from typing import Any

from hlr.drawing.notes import Note
from hlr.source.mesh.pair import is_pair


def is_collection(thing: Any) -> bool:
    """Whether it is a list, or a dict: what has an order, and can be read more than once; not a pair of arrays."""
    return isinstance(thing, list | tuple | Mapping | ValuesView) and not is_pair(thing)


def is_made_of(thing: Any, is_one: Callable[[Any], bool], within: tuple[int, ...] = ()) -> bool:
    """Whether it is one of what `is_one` knows, or a list or a dict of such, among which None and empty ones may be.

    within: ids of the lists and dicts that it is in; one that holds itself is not accepted
    """
    if is_one(thing):
        return True
    if not is_collection(thing) or id(thing) in within:
        return False
    items = [item for item in items_of(thing) if not is_nothing(item)]
    return bool(items) and all(is_made_of(item, is_one, (*within, id(thing))) for item in items)


def only(thing: Any, is_one: Callable[[Any], bool]) -> Any:
    """What is of one kind, of a list or a dict and of those inside of it; None: nothing is.

    thing: `is_made_of` it and others, so no list or dict holds itself
    """
    if is_one(thing):
        return thing
    if isinstance(thing, Mapping):
        return _only_named(thing, is_one) or None
    if not is_collection(thing):
        return None
    return [own for item in thing if (own := only(item, is_one)) is not None] or None


def _only_named(thing: Mapping[Any, Any], is_one: Callable[[Any], bool]) -> dict[Any, Any]:
    found: dict[Any, Any] = {}
    for key, item in thing.items():
        own = only(item, is_one)
        if isinstance(own, dict) and len(own) == 1 < sum(not is_nothing(each) for each in items_of(item)):
            # Alone it would be named by the outer key, which others that are left out here have as well.
            ((inner, single),) = own.items()
            found[f"{key}/{inner}"] = single
        elif own is not None:
            found[key] = own
    return found


def items_of(thing: Any) -> list[Any]:
    """What is in a list or a dict."""
    return list(thing.values() if isinstance(thing, Mapping) else thing)


def is_nothing(thing: Any, within: tuple[int, ...] = ()) -> bool:
    """Whether it is None, or a list or a dict with nothing but such in it. within: ids of what it is in."""
    if thing is None:
        return True
    if not is_collection(thing) or id(thing) in within:
        return False
    return all(is_nothing(item, (*within, id(thing))) for item in items_of(thing))


def things_in(thing: Any, within: tuple[int, ...] = ()) -> Iterator[Any]:
    """What is in a list or a dict and in those inside of it; of anything else itself. within: ids of what it is in."""
    if not is_collection(thing):
        yield thing
    elif id(thing) not in within:
        for item in items_of(thing):
            yield from things_in(item, (*within, id(thing)))


def left_out_of(thing: Any, where: str = "") -> Iterator[Note]:
    """A warning for each None, and each empty list or dict, in one. where: the keys and numbers of what this is in."""
    if not is_collection(thing):
        return
    pairs = thing.items() if isinstance(thing, Mapping) else enumerate(thing, 1)
    for key, item in pairs:
        path = f"{where}/{key}" if where else str(key)
        if item is None or (is_collection(item) and not len(item)):
            what = f'Part "{path}"' if isinstance(thing, Mapping) or where else f"Item {key} of the list"
            yield Note("part-left-out", f"{what} is {'None' if item is None else 'empty'} and was left out.")
        else:
            yield from left_out_of(item, path)


def name_under(key: str, name: str, own: str, alone: bool) -> str:
    """The name of a part of what a dict has under a key. Parts of an assembly are named by their path, key/child.

    own: the name that the object has by itself, or ""; it gives way to the key. alone: it has no other part
    """
    return key if alone or name in (own, key) else f"{key}/{name}"


def why_not_read(thing: Any, is_read: Callable[[Any], bool]) -> str | None:
    """What is wrong with a set, an iterator, a dict, or a list of which some is read; None: it is something else.

    is_read: whether an item can be drawn
    """
    if isinstance(thing, AbstractSet):
        return "it has no order: pass a list, or a dict of names and shapes"
    if isinstance(thing, Iterator):
        return "it can be read only once: pass a list of what it gives"
    if is_nothing(thing) and thing is not None:
        return "it holds no shapes"
    if not isinstance(thing, Mapping) and not (is_collection(thing) and any(map(is_read, items_of(thing)))):
        return None
    return _unread(thing, is_read, (id(thing),))


def _unread(thing: Any, is_read: Callable[[Any], bool], within: tuple[int, ...]) -> str:
    """What in a list or a dict, or in those inside of it, cannot be drawn. within: ids of it and of what it is in."""
    bad = next((item for item in items_of(thing) if not is_nothing(item) and not is_read(item)), None)
    if bad is None:
        return "no mesh in it has a triangle"
    if id(bad) in within:
        return f"{type(bad).__name__} in it holds itself"
    if is_collection(bad):
        return _unread(bad, is_read, (*within, id(bad)))
    return f"{type(bad).__name__} in it is no CAD object and no mesh, as all that it holds must be"
