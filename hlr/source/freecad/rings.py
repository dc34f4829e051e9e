"""Objects of a FreeCAD document that hold one another: groups and links that lead back to themselves."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable


def rings(names: Collection[str], held: Callable[[str], Iterable[str]]) -> dict[str, int]:
    """The number of the ring that each object is in: those that lead to one another have the same, others their own.

    held: the names of what an object holds or refers to; such as are not among `names` do not count. (Tarjan's
    algorithm, without recursion: rings may be long.)
    """
    found: dict[str, int] = {}
    order: dict[str, int] = {}
    lowest: dict[str, int] = {}
    open_ones: list[str] = []
    for first in names:
        if first in order:
            continue
        way = [(first, iter(list(held(first))))]
        order[first] = lowest[first] = len(order)
        open_ones.append(first)
        while way:
            name, ahead = way[-1]
            for other in ahead:
                if other not in names:
                    continue
                if other not in order:
                    order[other] = lowest[other] = len(order)
                    open_ones.append(other)
                    way.append((other, iter(list(held(other)))))
                    break
                if other not in found:
                    lowest[name] = min(lowest[name], order[other])
            else:
                way.pop()
                if way:
                    above = way[-1][0]
                    lowest[above] = min(lowest[above], lowest[name])
                if lowest[name] == order[name]:
                    number = order[name]
                    while name not in found:
                        found[open_ones.pop()] = number
    return found
