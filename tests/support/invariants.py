"""Checks that hold for every scene, clipped or not: the tables that refer to one another are consistent."""

from __future__ import annotations

import numpy as np

from hlr.scene.scene import Scene
from hlr.tables.line_classes import INTERIOR, EdgeClass


def check(scene: Scene, *, gaps: bool = False) -> None:
    """Raises AssertionError with the first table that contradicts another one; gaps: chains may have gaps."""
    n, t, e = len(scene.points), len(scene.triangles), len(scene.edges)
    groups, parts = len(scene.groups), len(scene.parts)
    assert np.isfinite(scene.points).all(), "points are finite"
    for name, array, count in (
        ("triangle_part", scene.triangle_part, t),
        ("triangle_group", scene.triangle_group, t),
        ("triangle_face", scene.triangle_face, t),
        ("edge_part", scene.edge_part, e),
        ("edge_group", scene.edge_group, e),
        ("edge_kind", scene.edge_kind, e),
        ("edge_curved", scene.edge_curved, e),
        ("offsets", scene.offsets, e + 1),
    ):
        assert array.shape == (count,), f"{name} has one entry each"
    for name in ("cull", "sound", "without_brep", "planar", "extent", "low", "high"):
        assert len(getattr(scene.groups, name)) == groups, f"groups.{name} has one entry each"
    _within("triangles", scene.triangles, n)
    _within("triangle_part", scene.triangle_part, parts)
    _within("triangle_group", scene.triangle_group, groups)
    _within("edge_part", scene.edge_part, parts)
    _within("edge_group", scene.edge_group, groups)
    _edges(scene, n, t)
    _groups(scene)
    _chains(scene, e, parts)
    if not gaps:
        _walks(scene)


def _within(name: str, values: np.ndarray, end: int) -> None:
    assert ((values >= 0) & (values < end)).all(), f"{name} refer to what is there"


def _edges(scene: Scene, n: int, t: int) -> None:
    edges = scene.edges
    _within("edges", edges, n)
    assert (edges[:, 0] < edges[:, 1]).all(), "the lower vertex comes first"
    assert len(np.unique(edges, axis=0)) == len(edges), "every edge is there once"
    assert scene.offsets[0] == 0 and (np.diff(scene.offsets) >= 0).all(), "offsets ascend"
    assert scene.offsets[-1] == len(scene.incident) == 3 * t, "every side of every triangle belongs to one edge"
    # The triangles of each edge, computed from the triangles alone.
    sides = np.sort(scene.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(t), 3)
    expected = sorted(zip(*sides.T.tolist(), owner.tolist(), strict=True))
    of = np.repeat(np.arange(len(edges)), np.diff(scene.offsets))
    found = sorted(zip(*edges[of].T.tolist(), scene.incident.tolist(), strict=True))
    assert found == expected, "an edge's triangles are those that have it as a side"
    tied = np.diff(scene.offsets) > 0
    first = scene.incident[scene.offsets[:-1][tied]]
    assert (scene.edge_part[tied] == scene.triangle_part[first]).all(), "an edge is of its triangles' part"
    assert (scene.edge_part[of] == scene.triangle_part[scene.incident]).all(), "parts share no edge"
    assert (scene.edge_group[of] == scene.triangle_group[scene.incident]).all(), "groups share no edge"
    kinds = {int(k) for k in EdgeClass} | {INTERIOR}
    assert set(scene.edge_kind.tolist()) <= kinds, "kinds are edge classes"
    assert not (~tied & (scene.edge_kind == INTERIOR)).any(), "an edge without triangles comes from a source edge"
    assert not scene.edge_curved[~tied].any(), "no outline without a surface"


def _groups(scene: Scene) -> None:
    groups = scene.groups
    one = {}
    for group, part in zip(scene.triangle_group.tolist(), scene.triangle_part.tolist(), strict=True):
        assert one.setdefault(group, part) == part, "a group belongs to one part"
    assert not (groups.cull & ~groups.closed).any(), "only closed groups are culled"
    assert not (groups.sound & groups.without_brep).any(), "nobody vouches for a mesh without B-rep"
    a, b, c = scene.triangles.T
    for group in np.unique(scene.triangle_group).tolist():
        mine = scene.triangle_group == group
        corners = scene.points[scene.triangles[mine]].reshape(-1, 3)
        assert (corners >= groups.low[group]).all() and (corners <= groups.high[group]).all(), "boxes hold their group"
        if groups.closed[group]:
            along = np.concatenate([np.stack(s, axis=1)[mine] for s in ((a, b), (b, c), (c, a))])
            there, back = sorted(map(tuple, along.tolist())), sorted(map(tuple, along[:, ::-1].tolist()))
            assert there == back, "a closed group uses every edge as often one way as the other"


def _chains(scene: Scene, e: int, parts: int) -> None:
    chains = scene.walks
    count = len(chains.kind)
    assert len(chains.part) == len(chains.index) == count == len(chains.offsets) - 1, "chains have one entry each"
    assert chains.offsets[0] == 0 and (np.diff(chains.offsets) >= 0).all(), "chain offsets ascend"
    assert chains.offsets[-1] == len(chains.edges) == len(chains.reversed), "chains take all members"
    _within("chains", chains.edges, e)
    _within("chains.part", chains.part, parts)
    assert (np.diff(chains.part) >= 0).all(), "chains are sorted by part"
    of = np.repeat(np.arange(count), np.diff(chains.offsets))
    assert (scene.edge_part[chains.edges] == chains.part[of]).all(), "a chain's edges are of its part"
    on_chain = np.zeros(e, bool)
    on_chain[chains.edges] = True
    assert (on_chain == (scene.edge_kind != INTERIOR)).all(), "an edge has a kind where a chain runs, and only there"


def _walks(scene: Scene) -> None:
    chains = scene.walks
    ends = scene.edges[chains.edges].copy()
    ends[chains.reversed] = ends[chains.reversed][:, ::-1]
    of = np.repeat(np.arange(len(chains.kind)), np.diff(chains.offsets))
    next_too = of[1:] == of[:-1]
    assert (ends[:-1, 1][next_too] == ends[1:, 0][next_too]).all(), "a chain is a walk without gaps"
