"""Memory of a frame, computed before drawing. After it, `Statistics.memory` counts the scene's share as well."""

from __future__ import annotations

from hlr.lab.methods.table import checked
from hlr.lab.methods.viewport import checked_size

ID, DEPTH = 4, 8
"""Bytes: the number of a polygon, and a depth in floating point."""

ROW_METHODS = ("scan-line z-buffer",)
"""Methods that hold one row of depths, with the polygon that each belongs to."""


def frame_memory(width: int, height: int, colour: int = 4, depth: int = 4, doubled: bool = False) -> int:
    """Bytes of a frame. colour, depth: bytes per pixel; doubled: double buffering, one frame shown and one drawn."""
    return width * height * (colour + depth) * (2 if doubled else 1)


def method_memory(method: str, size: tuple[int, int]) -> int:
    """Bytes that a method holds while it works, whatever the scene: its frame of ids, and its depths.

    Edges, lists, pieces and trees are not included: they grow with the scene and not with the picture (except the
    heads of an edge table, 4 bytes a row). Raises OptionError for an unknown method or a wrong size.
    """
    method, _ = checked(method, None)
    width, height = checked_size(size)
    if method == "z-buffer":
        return frame_memory(width, height, ID, DEPTH)
    row = frame_memory(width, 1, ID, DEPTH) if method in ROW_METHODS else 0
    return frame_memory(width, height, ID, 0) + row


def picture_memory(size: tuple[int, int]) -> int:
    """Bytes of a finished `Rendering`: ids and depths, whatever the method."""
    width, height = checked_size(size)
    return frame_memory(width, height, ID, DEPTH)


def peak_memory(method: str, size: tuple[int, int]) -> int:
    """Peak bytes that a process needs for one call of `render`, without the scene.

    The method frees its depths before the picture is made from its frame, so the larger of the two counts.
    """
    width, height = checked_size(size)
    return max(method_memory(method, size), frame_memory(width, height, ID, 0) + picture_memory(size))
