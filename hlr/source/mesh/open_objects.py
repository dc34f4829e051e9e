"""Meshes in memory as a source: one, a list of them, or a dict whose keys are the names of the parts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hlr.common.types import Color
from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.source.collected import is_collection, is_made_of, left_out_of, name_under
from hlr.source.mesh.mesh_source import Instance, MeshSource, unique_names
from hlr.source.mesh.objects import Meshes, is_manifold, is_trimesh, own_name, read_manifold, read_pair, read_trimesh
from hlr.source.mesh.pair import is_pair
from hlr.source.model import Frame
from hlr.source.transforms import compose, matrix4
from hlr.tables.readers import what_to_pass

_KINDS = ((is_trimesh, read_trimesh), (is_manifold, read_manifold), (is_pair, read_pair))
"""Whether an object is a mesh of some kind, and what reads it."""


def is_mesh(thing: Any) -> bool:
    """Whether it is one mesh, or a trimesh.Scene. Nothing is imported."""
    return any(is_kind(thing) for is_kind, _ in _KINDS)


def are_meshes(thing: Any) -> bool:
    """Whether `open_meshes` opens an object: a mesh, or a list or a dict of them. Nothing is imported."""
    return is_made_of(thing, is_mesh)


def hold_triangles(thing: Any) -> bool:
    """Whether meshes can be read and have triangles: any two arrays could be a pair of vertices and faces."""
    try:
        return are_meshes(thing) and any(len(faces) for each in read_meshes(thing) for _, faces in each.geometries)
    except SourceError:
        return False


def open_meshes(thing: Any) -> MeshSource:
    """A mesh, a list of meshes, or a dict that gives them names. Each is a part, or as many as it has names for.

    None in a list or a dict, as an optional part is, is left out with a warning; so is a mesh without triangles.

    Raises:
        SourceError: there are no triangles, or a mesh cannot be read.
    """
    name = "mesh" if is_pair(thing) else type(thing).__name__
    return mesh_source(name, read_meshes(thing), list(left_out_of(thing)))


def mesh_source(
    name: str, read: Sequence[Meshes], notes: Sequence[Note], *, in_world: bool = False, taken: Sequence[str] = ()
) -> MeshSource:
    """One source of all that was read. Where units or up axes differ, it has millimetres, and z is up.

    in_world: it has so in any case; taken: names that no part gets

    Raises:
        SourceError: there are no triangles.
    """
    frames = [Frame()] if in_world else list(dict.fromkeys(each.frame for each in read))
    geometries: list[tuple[Any, Any]] = []
    instances: list[Instance] = []
    for each in read:
        first = len(geometries)
        geometries += each.geometries
        placed = each.instances if frames == [each.frame] else _in_world(each)
        instances += [replace(instance, geometry=first + instance.geometry) for instance in placed]
    if taken:
        names = unique_names([*taken, *[instance.name for instance in instances]])[len(taken) :]
        instances = [replace(each, name=unique) for each, unique in zip(instances, names, strict=True)]
    return MeshSource(name, "mesh", geometries, instances, frames[0] if len(frames) == 1 else Frame(), notes)


def read_meshes(thing: Any, name: str = "part", color: Color | None = None, opacity: float = 1.0) -> list[Meshes]:
    """The meshes of what `are_meshes` accepts, in order. name, color, opacity: where a mesh has none of its own.

    Raises:
        SourceError: one cannot be read, or is no mesh.
    """
    for is_kind, read in _KINDS:
        if is_kind(thing):
            found = read(thing, name)
            return [found] if color is None else [replace(found, instances=_colored(found.instances, color, opacity))]
    if isinstance(thing, Mapping):
        return [each for key, item in thing.items() for each in _of_key(str(key) or name, item, color, opacity)]
    if not is_collection(thing):
        raise SourceError(f"An object of type {type(thing).__name__} cannot be drawn: pass {what_to_pass()}.")
    return [each for item in thing if item is not None for each in read_meshes(item, name, color, opacity)]


def _of_key(key: str, thing: Any, color: Color | None, opacity: float) -> list[Meshes]:
    """The meshes of what a dict has under a key."""
    if thing is None:
        return []
    own = own_name(thing) if is_trimesh(thing) else ""
    read = read_meshes(thing, key, color, opacity)
    alone = sum(len(each.instances) for each in read) == 1
    return [
        replace(each, instances=[replace(i, name=name_under(key, i.name, own, alone)) for i in each.instances])
        for each in read
    ]


def _colored(instances: Iterable[Instance], color: Color, opacity: float) -> list[Instance]:
    return [each if each.color is not None else replace(each, color=color, opacity=opacity) for each in instances]


def _in_world(read: Meshes) -> list[Instance]:
    """Meshes that lie in the drawing's world as they did in their own frame."""
    up, unit = read.frame.up, read.frame.unit
    world = tuple(float(value) for row in up for value in (*(unit * axis for axis in row), 0.0))
    own = [tuple(np.asarray(each.transform, np.float64)[:3].ravel().tolist()) for each in read.instances]
    return [
        replace(each, transform=matrix4(compose(world, place))) for each, place in zip(read.instances, own, strict=True)
    ]
