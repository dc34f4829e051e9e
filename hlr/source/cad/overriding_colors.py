"""Colours that a document gives to one place of a part deep in an assembly (OpenCASCADE's SHUO).

The colour belongs to a way: from a component of an assembly down to a component of what that holds. Each component on
the way has a node, which is a child of the node of the component above it. The topmost node has the colour.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from hlr.common.types import Rgba
from hlr.source.cad.annotation import label_entry
from hlr.source.cad.occt_collections import new_collection


class OverridingColors:
    """Those of a document."""

    def __init__(self, shapes: Any, color_of: Callable[[Any], Rgba | None]) -> None:
        """Args: shapes: the document's XCAFDoc_ShapeTool; color_of: returns a label's own colour."""
        self._shapes, self._color_of = shapes, color_of
        self._nodes: dict[str, list[Any]] = {}

    def of(self, path: Sequence[Any]) -> Rgba | None:
        """The colour of the last label of a path through the assembly. Of several ways to it the longest decides."""
        if not self._nodes_at(path[-1]):
            return None
        for first in range(len(path) - 1):
            for node in self._nodes_at(path[first]):
                color = self._color_of(node.Label())
                if color is not None and _leads_along(node, path[first + 1 :]):
                    return color
        return None

    def _nodes_at(self, label: Any) -> list[Any]:
        key = label_entry(label)
        if key not in self._nodes:
            found = new_collection("attributes")
            if self._shapes.IsComponent_s(label):
                self._shapes.GetAllComponentSHUO_s(label, found)
            self._nodes[key] = [found.Value(i) for i in range(1, found.Length() + 1)]
        return self._nodes[key]


def _leads_along(node: Any, labels: Sequence[Any]) -> bool:
    """Whether the way from a node runs along these labels, and ends at the last of them."""
    children = [node.GetChild(i) for i in range(1, node.NbChildren() + 1)]
    if not labels:
        return not children
    at = label_entry(labels[0])
    return any(label_entry(child.Label().Father()) == at and _leads_along(child, labels[1:]) for child in children)
