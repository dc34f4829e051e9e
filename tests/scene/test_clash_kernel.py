"""`_kernel.clashes` against an exact oracle, on soups of triangles so small that coincidences are as common as not."""

from __future__ import annotations

import hashlib
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scene.oracle_of_clashes import common

from hlr import _kernel
from support.programs import environment

TETRAHEDRON = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]


def groups(size):
    point = st.tuples(*[st.integers(0, size)] * 3)
    group = st.one_of(st.lists(point, min_size=3, max_size=3), st.lists(point, min_size=4, max_size=4))
    return st.lists(group, min_size=2, max_size=5)


soups = st.tuples(st.sampled_from([2, 4]).flatmap(groups), st.lists(st.booleans(), min_size=5, max_size=5))


class Soup:
    """Groups of a triangle or a tetrahedron each, with points of their own."""

    def __init__(self, groups, itself):
        points, triangles, owner = [], [], []
        for g, corners in enumerate(groups):
            faces = TETRAHEDRON if len(corners) == 4 else [[0, 1, 2]]
            triangles += [[len(points) + v for v in face] for face in faces]
            owner += [g] * len(faces)
            points += corners
        self.points = np.array(points, float)
        self.triangles = np.array(triangles, np.int32)
        self.owner = np.array(owner, np.int32)
        self.itself = np.array(itself[: len(groups)], bool)
        # Powers of two apart: the kernel keeps integers exactly, and rounds what it finds to this step.
        self.step = float(np.ptp(self.points, axis=0).max()) * 2.0**-28

    def found(self):
        """{(lower triangle, higher triangle): (ends (2, 3), depth, sine)}"""
        return rows(_kernel.clashes(self.points, self.triangles, self.owner, self.itself))

    def corners(self, t):
        return self.points[self.triangles[t]].astype(int).tolist()

    def tried(self, t, u):
        if self.owner[t] != self.owner[u]:
            return True
        neighbours = len(set(self.triangles[t].tolist()) & set(self.triangles[u].tolist())) > 1
        return bool(self.itself[self.owner[t]]) and not neighbours


def rows(answer):
    ends = answer["points"][answer["edges"]]
    pairs = [tuple(sorted(pair)) for pair in answer["triangles"].tolist()]
    assert len(set(pairs)) == len(pairs), "a pair of triangles is there twice"
    return dict(zip(pairs, zip(ends, answer["depth"], answer["sine"], strict=True), strict=True))


def same_ends(found, wanted, step):
    """In either order, each coordinate within a step of the grid."""
    wanted = np.array([[float(c) for c in end] for end in wanted])
    return any(np.abs(found - order).max() <= step for order in (wanted, wanted[::-1]))


def judge(soup, found):
    """What is wrong with the answer, in words."""
    told = []
    count = len(soup.triangles)
    for pair in ((t, u) for t in range(count) for u in range(t + 1, count)):
        wanted = common(soup.corners(pair[0]), soup.corners(pair[1])) if soup.tried(*pair) else None
        said = found.get(pair)
        if said is None:
            if wanted is not None and wanted.depth > 0:
                told.append(f"{pair} not found")
        elif wanted is None:
            told.append(f"{pair} do not meet in a segment")
        elif not same_ends(said[0], wanted.ends, soup.step):
            told.append(f"{pair} end elsewhere")
        elif said[1] != pytest.approx(wanted.depth, rel=1e-9) or said[2] != pytest.approx(wanted.sine, rel=1e-9):
            told.append(f"{pair}: {said[1:]}, not {wanted.depth, wanted.sine}")
    return told


@pytest.mark.slow
@given(soups)
@settings(max_examples=300)
def test_all_that_meet_and_nothing_else(soup):
    soup = Soup(*soup)
    assert not judge(soup, soup.found())


def test_general_position_and_coincidence_both_occur():
    """How many of a thousand pairs meet deeply, how many in passing."""
    rng = np.random.default_rng(1)
    deep = passing = 0
    for _ in range(100):
        soup = Soup(rng.integers(0, 3, (5, 3, 3)).tolist(), [False] * 5)
        found = soup.found()
        assert not judge(soup, found)
        deep += sum(depth > 0 for _, depth, _ in found.values())
        passing += sum(depth == 0 for _, depth, _ in found.values())
    assert deep > 40 and passing > 10


@pytest.mark.parametrize(
    "spoil",
    [
        lambda found: found.pop(next(iter(found))),
        lambda found: found.update({(0, 2): next(iter(found.values()))}),
        lambda found: found.update({k: (v[0] + 1e-6, *v[1:]) for k, v in found.items()}),
        lambda found: found.update({k: (v[0], 1.01 * v[1], v[2]) for k, v in found.items()}),
        lambda found: found.update({k: (*v[:2], 0.99 * v[2]) for k, v in found.items()}),
    ],
)
def test_the_judge_notices(spoil):
    wall, floor = [(2, 0, 0), (2, 2, 0), (2, 1, 4)], [(0, 0, 1), (4, 0, 1), (4, 4, 1)]
    soup = Soup([floor, wall, [(0, 0, 3), (1, 0, 3), (0, 1, 3)]], [False] * 3)
    found = soup.found()
    assert list(found) == [(0, 1)] and not judge(soup, found)
    spoil(found)
    assert judge(soup, found)


@pytest.mark.slow
@given(soups, st.randoms(use_true_random=False))
@settings(max_examples=100)
def test_the_order_of_groups_and_triangles_is_no_matter(soup, random):
    soup = Soup(*soup)
    before = soup.found()
    names = list(range(len(soup.itself)))
    order = list(range(len(soup.triangles)))
    random.shuffle(names)
    random.shuffle(order)
    owner = np.array([names[g] for g in soup.owner], np.int32)
    itself = np.empty_like(soup.itself)
    itself[names] = soup.itself
    answer = _kernel.clashes(soup.points, soup.triangles[order], owner[order], itself)
    after = {tuple(sorted((order[t], order[u]))): row for (t, u), row in rows(answer).items()}
    # A triangle that ends on another's plane meets it or not, by a rule of its own: not in passing.
    assert before.keys() == after.keys()
    for pair, (ends, depth, sine) in before.items():
        assert np.array_equal(ends, after[pair][0]) and (depth, sine) == after[pair][1:]


@pytest.mark.slow
@given(soups, st.lists(st.permutations([0, 1, 2]), min_size=20, max_size=20))
@settings(max_examples=100)
def test_turning_triangles_is_no_matter_where_they_meet_deeply(soup, turns):
    soup = Soup(*soup)
    before = {pair: row for pair, row in soup.found().items() if row[1] > 0}
    soup.triangles = np.array([t[turn] for t, turn in zip(soup.triangles, turns, strict=False)], np.int32)
    after = {pair: row for pair, row in soup.found().items() if row[1] > 0}
    assert before.keys() == after.keys()
    for pair, (ends, depth, _) in before.items():
        assert np.array_equal(ends, after[pair][0]) and depth == pytest.approx(after[pair][1])


@given(soups)
@settings(max_examples=60)
def test_rows_are_sorted_and_name_the_lower_group_first(soup):
    soup = Soup(*soup)
    answer = _kernel.clashes(soup.points, soup.triangles, soup.owner, soup.itself)
    pairs = answer["triangles"].tolist()
    keys = [(soup.owner[t], soup.owner[u], t, u) for t, u in pairs]
    assert keys == sorted(keys)
    assert all((soup.owner[t], t) < (soup.owner[u], u) for t, u in pairs)
    points = answer["points"].tolist()
    assert len(set(map(tuple, points))) == len(points), "two ends in one place"


def balls(count):
    """Spheres in a row that overlap, as one soup for all threads to share: some thousand triangles."""
    import trimesh

    meshes = [trimesh.creation.icosphere(3, 1.0).apply_translation((1.1 * k, 0.1 * k, 0.05 * k)) for k in range(count)]
    points = np.concatenate([m.vertices for m in meshes])
    first = np.cumsum([0, *[len(m.vertices) for m in meshes]])
    triangles = np.concatenate([m.faces + n for m, n in zip(meshes, first, strict=False)]).astype(np.int32)
    owner = np.repeat(np.arange(count, dtype=np.int32), [len(m.faces) for m in meshes])
    return np.ascontiguousarray(points, float), triangles, owner, np.ones(count, bool)


def digest():
    answer = _kernel.clashes(*balls(4))
    assert len(answer["edges"]) > 100
    whole = b"".join(answer[k].tobytes() for k in ("points", "edges", "triangles", "depth", "sine"))
    return hashlib.sha256(whole).hexdigest()


@pytest.mark.slow
def test_threads_are_no_matter():
    told = set()
    for threads in ("1", "2", "5"):
        env = environment(RAYON_NUM_THREADS=threads)
        told.add(subprocess.run([sys.executable, __file__], env=env, check=True, capture_output=True).stdout)
    assert len(told) == 1 and len(told.pop().strip()) == 64


@pytest.mark.parametrize(
    "spoil",
    [
        lambda a: a.update(points=np.full((3, 3), np.nan)),
        lambda a: a.update(triangles=a["triangles"] + 1),
        lambda a: a.update(triangles=a["triangles"] - 1),
        lambda a: a.update(triangle_group=a["triangle_group"] + 1),
        lambda a: a.update(triangle_group=np.zeros(2, np.int32)),
    ],
)
def test_wrong_arrays_are_refused(spoil):
    arrays = {
        "points": np.eye(3),
        "triangles": np.array([[0, 1, 2]], np.int32),
        "triangle_group": np.zeros(1, np.int32),
        "itself": np.ones(1, bool),
    }
    assert not len(_kernel.clashes(**arrays)["edges"])
    spoil(arrays)
    with pytest.raises(ValueError, match=r"point|triangle"):
        _kernel.clashes(**arrays)


if __name__ == "__main__":
    sys.stdout.write(digest())
