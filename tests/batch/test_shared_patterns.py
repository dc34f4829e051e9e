"""Patterns of parts that several sources share need not name a part of each."""

from __future__ import annotations

import pytest
from batch.models import tetrahedron

from hlr.batch.carry_out import carry_out
from hlr.batch.keys import Digests, key_of
from hlr.batch.manifest import manifest_of
from hlr.batch.plan import plan
from hlr.batch.run import Done
from hlr.batch.unused_patterns import unused_patterns


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HLR_CACHE", "off")
    cube = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
    faces = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
    again = "".join("f " + " ".join(str(int(n) + 8) for n in row.split()[1:]) + "\n" for row in faces.splitlines())
    (tmp_path / "a.obj").write_text(f"o plate\n{cube}{faces}o bolt\n{cube.replace('1', '3')}{again}")
    tetrahedron(tmp_path / "b.off", 1)
    return tmp_path


def done(folder, **keys):
    asked = plan(manifest_of({"views": ["front"], **keys}, folder), folder / "drawings")
    return Done(asked, tuple(map(carry_out, asked.jobs)), tuple(range(len(asked.jobs))))


def codes(outcome):
    return [note["code"] for note in outcome.drawings[0]["notes"] if not note["warning"]]


def test_a_source_without_such_a_part_is_drawn_with_a_remark(folder):
    found = done(folder, hide=["bolt", "zzz*"])
    assert [outcome.failure for outcome in found.outcomes] == [None, None]
    with_bolt, without = found.outcomes
    assert with_bolt.drawings[0]["parts"] == 1
    assert codes(with_bolt).count("pattern-unused") == 1 and codes(without).count("pattern-unused") == 2
    assert list(unused_patterns(found)) == ['hide "zzz*" matches no part in any of its sources']


def test_only_that_leaves_nothing_is_refused(folder):
    with_bolt, without = done(folder, only=["bolt", "zzz*"]).outcomes
    assert with_bolt.failure is None and codes(with_bolt) == ["pattern-unused"]
    assert 'only "bolt" matches no part' in without.failure.message


def test_a_single_source_has_to_have_the_part(folder):
    (outcome,) = (found := done(folder, files="b.off", hide=["bolt"])).outcomes
    assert 'hide "bolt" matches no part' in outcome.failure.message and not list(unused_patterns(found))


def test_what_was_drawn_with_others_is_not_taken_for_a_single_source(folder):
    alone, shared = (
        plan(manifest_of({"files": files, "hide": ["bolt"]}, folder), folder / "drawings").jobs[-1]
        for files in ("b.off", ["a.obj", "b.off"])
    )
    assert alone.source == shared.source and key_of(alone, Digests()) != key_of(shared, Digests())
