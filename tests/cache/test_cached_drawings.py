"""A CAD file that was read before is not read again, and nothing else changes."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import hlr
from hlr.cache.entry import packed, unpacked
from hlr.source import open_source
from hlr.source.cad import cache_key
from hlr.source.cad.cached_files import to_entry

DATA = Path(__file__).parents[1] / "data"
ASSEMBLY, PART, SCREW = (
    DATA / name for name in ("as1-oc-214.stp", "nist_ctc_01_asme1_ap242-e1.stp", "M6-1x12-countersunk-screw.step")
)


def entry_of(folder):
    (path,) = folder.iterdir()
    return path


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    """One small file of each kind: coloured, mirrored, with wires, of triangles alone."""
    cq = pytest.importorskip("cadquery")
    from OCP.BRepTools import BRepTools
    from OCP.IGESControl import IGESControl_Writer

    folder = tmp_path_factory.mktemp("models")
    body = cq.Workplane().box(20, 10, 5).edges("|Z").fillet(2).faces(">Z").hole(4)
    whole = cq.Assembly(name="whole")
    whole.add(body, name="body", color=cq.Color(1, 0, 0, 0.5))
    whole.add(body, name="again", loc=cq.Location((0, 30, 0), (0, 0, 1), 30), color=cq.Color(0, 0, 1))
    whole.add(cq.Workplane().sphere(4), name="ball", loc=cq.Location((0, 0, 9)))
    whole.export(str(folder / "colours.step"))
    both = cq.Compound.makeCompound([body.val(), body.val().mirror("XZ", (0, 40, 0)), cq.Edge.makeLine((0, 0), (5, 5))])
    both.exportBrep(str(folder / "wires.brep"))
    writer = IGESControl_Writer()
    writer.AddShape(body.val().wrapped)
    writer.Write(str(folder / "faces.igs"))
    BRepTools.Write_s(cq.Solid.makeTorus(9, 3).wrapped, str(folder / "torus.brp"))
    return sorted(folder.iterdir())


def everything(path):
    """All that is told of a file, as bytes."""
    drawings = hlr.draw_views(path, ["iso", "front"], hlr.Options(smooth=True, fit=(100, 80)))
    picture = hlr.preview(path, size=(90, 60), edges=True, ids=True)
    stated = []
    for drawing in drawings:
        document = json.loads(drawing.to_json())
        del document["timings"]
        stated.append(document)
    plans = [[(d.name, d.on, d.reason) for d in plan.decisions] for plan in hlr.plan_views(path, ["iso"])]
    svgs = [drawing.to_svg() for drawing in drawings]
    return stated, svgs, hlr.info(path), plans, picture.pixels.tobytes(), picture.ids.tobytes()


@pytest.mark.slow
def test_all_is_the_same_with_the_cache_without_it_and_out_of_it(models, monkeypatch, own_cache):
    for path in [*models, ASSEMBLY, PART]:
        monkeypatch.setenv("HLR_CACHE", "off")
        without = everything(path)
        monkeypatch.setenv("HLR_CACHE", str(own_cache))
        assert "is in the cache now" in open_source(path).reading
        assert "was not read again" in open_source(path).reading
        assert without == everything(path)


@pytest.mark.slow
def test_a_choice_of_parts_is_the_same_out_of_the_cache(models, monkeypatch, own_cache):
    for path, wish in (
        (ASSEMBLY, {"hide": ("*bolt*",)}),
        (ASSEMBLY, {"only": ("*nut*",)}),
        (models[0], {"only": ("ball",)}),
    ):
        monkeypatch.setenv("HLR_CACHE", "off")
        without = hlr.draw(path, **wish)
        monkeypatch.setenv("HLR_CACHE", str(own_cache))
        for _ in range(2):
            found = hlr.draw(path, **wish)
            assert found == without
            assert found.to_svg() == without.to_svg()


@pytest.mark.slow
def test_what_is_measured_of_a_drawing_is_the_same_out_of_the_cache(models):
    once, again = (hlr.draw(models[0], report=True).reached for _ in range(2))
    assert once == again


LOADED = """
import sys, hlr
for path in sys.argv[1:]:
    {}
    print(*sorted({{m.split('.')[0] for m in sys.modules}} & {{'OCP', 'cadquery', 'build123d'}}))
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "call",
    [
        "hlr.draw(path, scale=0.3, accuracy=0.2).to_svg()",
        "hlr.draw(path, 'front', fill=True, smooth=True, only=('*',)).to_pdf()",
        "hlr.preview(path, size=(90, 60), edges=True)",
        "hlr.info(path)",
        "hlr.plan_views(path, ['iso'])",
    ],
)
def test_opencascade_is_not_loaded_for_what_was_read_before(call, models):
    paths = (PART, *models)
    for path in paths:
        open_source(path)
    program = [sys.executable, "-P", "-c", LOADED.format(call), *map(str, paths)]
    told = subprocess.run(program, capture_output=True, text=True, check=True).stdout
    assert dict(zip(paths, told.splitlines(), strict=True)) == dict.fromkeys(paths, "")


@pytest.mark.slow
def test_the_command_does_not_load_it_either(tmp_path, own_cache):
    code = "import atexit, sys; atexit.register(lambda: print('OCP' in sys.modules)); "
    code += "from hlr.cli import main; main(sys.argv[1:])"
    command = [sys.executable, "-P", "-c", code, "draw", str(PART), "-q", "-o", str(tmp_path / "a.svg")]
    drawn = []
    for loaded in ("True", "False"):
        assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == f"{loaded}\n"
        drawn.append((tmp_path / "a.svg").read_bytes())
    assert drawn[0] == drawn[1]


@pytest.mark.slow
@pytest.mark.parametrize("code", ["not-meshed", "faces-mended"])
def test_a_face_that_our_mesher_cannot_mesh_comes_back_from_the_dump(code, tmp_path):
    """Only then OpenCASCADE is loaded; it has meshed the shape of the dump before, too."""
    pytest.importorskip("cadquery")
    from support.brep_shapes import plate_with_sliver, scrawled_cylinder

    path = tmp_path / "part.brep"
    (plate_with_sliver() if code == "not-meshed" else scrawled_cylinder()[0]).exportBrep(str(path))
    first = hlr.draw(path)
    assert [note.code for note in first.notes] == [code]
    program = "import sys, hlr; print(hlr.draw(sys.argv[1]).to_svg()); print('OCP' in sys.modules)"
    command = [sys.executable, "-P", "-c", program, str(path)]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert said == first.to_svg() + "\nTrue\n"
    (once, again) = (open_source(path).mesh(0.01, 0.3).parts[0] for _ in range(2))
    assert once.points.tobytes() == again.points.tobytes()
    assert once.triangles.tobytes() == again.triangles.tobytes()


def test_an_object_and_a_script_are_never_kept(own_cache, tmp_path):
    cq = pytest.importorskip("cadquery")
    hlr.draw(cq.Workplane().box(1, 2, 3))
    script = tmp_path / "part.py"
    script.write_text("import cadquery as cq\nresult = cq.Workplane().box(1, 2, 3)\n")
    assert hlr.draw(script).reading == ""
    hlr.draw(DATA / "soup.stl")
    assert not own_cache.exists()


def test_a_file_that_cannot_be_drawn_is_not_kept(own_cache, tmp_path):
    broken = tmp_path / "broken.step"
    broken.write_bytes(ASSEMBLY.read_bytes()[:2000])
    for _ in range(2):
        with pytest.raises(hlr.SourceError, match=r"broken\.step cannot be read as STEP"):
            hlr.draw(broken)
    assert not own_cache.exists()


@pytest.mark.slow
@pytest.mark.parametrize("change", ["content", "name", "code", "bindings"])
def test_what_was_read_from_something_else_or_by_something_else_is_not_used(change, tmp_path, own_cache, monkeypatch):
    part = tmp_path / "part.step"
    shutil.copy(ASSEMBLY, part)
    open_source(part)
    assert "not read again" in open_source(part).reading
    if change == "content":
        part.write_bytes(part.read_bytes().replace(b"'plate'", b"'PLATE'"))
    elif change == "name":
        part = part.rename(tmp_path / "other.step")
    elif change == "code":
        monkeypatch.setattr(cache_key, "_own_code", lambda: "another")
    else:
        monkeypatch.setattr(cache_key, "bindings", lambda: ["cadquery_ocp-9.dist-info"])
    cache_key._reader_versions.cache_clear()
    assert "is in the cache now" in open_source(part).reading
    assert len(list(own_cache.iterdir())) == 2
    cache_key._reader_versions.cache_clear()


def test_the_code_that_counts_is_the_version_and_all_that_reads():
    names = {"/".join(path.parts[-2:]) for path in cache_key.code_files()}
    read = {"cad/step.py", "cad/parts.py", "cad/cached_files.py", "mesh/mesh_file.py", "source/file_checks.py"}
    assert {"hlr/__init__.py", "tables/readers.py", "cache/entry.py", *read} <= names


def test_annotations_are_an_entry_of_their_own(own_cache):
    for annotations in (False, True):
        open_source(PART, annotations=annotations)
    assert len(list(own_cache.iterdir())) == 2


def test_a_copy_in_another_folder_is_not_read_again(tmp_path):
    open_source(ASSEMBLY)
    copy = shutil.copy(ASSEMBLY, tmp_path)
    assert "not read again" in open_source(copy).reading


def test_a_file_that_changes_while_it_is_read_is_not_kept(tmp_path, own_cache, monkeypatch):
    from hlr.source.cad import step

    part = tmp_path / "part.step"
    shutil.copy(ASSEMBLY, part)
    read = step.open_step

    def reading(path, annotations):
        found = read(path, annotations)
        path.write_bytes(path.read_bytes() + b"\n")
        return found

    monkeypatch.setattr(step, "open_step", reading)
    assert "not kept in the cache (the file has changed meanwhile)" in open_source(part).reading
    assert not own_cache.exists()
    monkeypatch.setattr(step, "open_step", lambda path, annotations: (read(path, annotations), path.unlink())[0])
    assert "not kept in the cache" in open_source(part).reading
    assert not own_cache.exists()


@pytest.mark.slow
def test_damage_anywhere_is_replaced(own_cache):
    """One byte of each stretch, and the end cut off at each: never used, never an error."""
    drawing = hlr.draw(ASSEMBLY)
    path = entry_of(own_cache)
    whole = path.read_bytes()
    # The header and the JSON byte by byte are in test_store; a drawing of each would take long.
    for at in [0, 7, 8, 40, 44, 52, 60, 2000, 5000, len(whole) // 2, len(whole) - 1]:
        for damaged in (whole[:at] + bytes([whole[at] ^ 4]) + whole[at + 1 :], whole[:at]):
            path.write_bytes(damaged)
            source = open_source(ASSEMBLY)
            assert "is in the cache now" in source.reading
            assert "was not used, for it" in source.reading
            assert path.read_bytes() == whole
    assert hlr.draw(open_source(ASSEMBLY)).to_svg() == drawing.to_svg()


def part_with(index, value):
    def change(facts, data):
        parts = [list(part) for part in facts["parts"]]
        parts[0][index] = value
        return facts | {"parts": parts}, data

    return change


def facts_with(**changes):
    return lambda facts, data: (facts | changes, data)


def data_with(at, value):
    """The bytes from there on, counted from the end of the numbers where it is negative."""

    def change(facts, data):
        return facts, data[:at] + value + data[at + len(value) :]

    return change


HOSTILE = {
    "no parts": facts_with(parts=[]),
    "parts are a number": facts_with(parts=3),
    "a part is short": lambda facts, data: (facts | {"parts": [part[:3] for part in facts["parts"]]}, data),
    "many roots": facts_with(prototypes=2**31 - 1),
    "endless roots": facts_with(prototypes=10**30),
    "negative roots": facts_with(prototypes=-1),
    "roots are a truth": facts_with(prototypes=True),
    "many faces": facts_with(faces=2**31 - 1),
    "a name is a number": part_with(0, 5),
    "a name is there twice": lambda facts, data: (
        facts | {"parts": [["a", *part[1:]] for part in facts["parts"]]},
        data,
    ),
    "a colour is bright": part_with(2, [2.0, 0, 0]),
    "a colour is a word": part_with(2, "red"),
    "a colour is long": part_with(2, [0.0] * 1000),
    "a root that there is not": part_with(3, 99),
    "a root before the first": part_with(3, -1),
    "a root is a fraction": part_with(3, 0.0),
    "transparent is a word": part_with(4, "no"),
    "a look of three": part_with(5, [0, 0, 0]),
    "an unknown note": facts_with(notes=[["come-what-may", "text"]]),
    "a note of a number": facts_with(notes=[["defects", 1]]),
    "notes are none": facts_with(notes=None),
    "a transform is no number": data_with(0, b"\xff" * 8),
    "a transform is endless": data_with(0, np.array([np.inf]).tobytes()),
    "the dump is cut": lambda facts, data: (facts, data[:-50]),
    "the dump is empty": lambda facts, data: (facts, data[: data.index(b"Open CASCADE")]),
    "the dump is another one": lambda facts, data: (facts, data[: data.index(b"\nOpen CASCADE")] + OTHER_DUMP()),
    "no data": lambda facts, data: (facts, b""),
}


def OTHER_DUMP():  # noqa: N802
    return open_source(SCREW).prototypes.dump


@pytest.mark.slow
@pytest.mark.parametrize("hostile", HOSTILE)
def test_an_entry_with_a_good_checksum_is_not_trusted(hostile, own_cache):
    source = open_source(ASSEMBLY)
    path = entry_of(own_cache)
    whole, name = path.read_bytes(), path.name.removesuffix(".model")
    facts, data = unpacked(name, whole)
    facts, data = HOSTILE[hostile](facts, bytes(data))
    path.write_bytes(b"".join(packed(name, facts, [data])))
    again = open_source(ASSEMBLY)
    assert "was not used, for its content does not fit together" in again.reading
    assert path.read_bytes() == whole
    assert again.infos() == source.infos()


@pytest.mark.slow
def test_every_number_of_an_entry_may_be_wrong(own_cache):
    """Bytes of the tables at random, with a good checksum: what is let through is drawn or refused in a sentence."""
    colours = open_source(ASSEMBLY)
    path = entry_of(own_cache)
    name = path.name.removesuffix(".model")
    facts, data = unpacked(name, path.read_bytes())
    tables, rng = bytes(data).index(b"Open CASCADE") - 1, np.random.default_rng(1)
    used = 0
    for _ in range(60):
        changed = bytearray(data)
        for at in rng.integers(0, tables, 2):
            changed[at] = rng.integers(256)
        path.write_bytes(b"".join(packed(name, facts, [bytes(changed)])))
        source = open_source(ASSEMBLY)
        used += "not read again" in source.reading
        try:
            source.bounds()
            source.appearances()
            source.infos()
        except hlr.SourceError:
            pass
    assert used
    assert colours.infos()


def test_nothing_is_kept_and_all_is_drawn_where_the_folder_cannot_be_written(tmp_path, monkeypatch):
    (tmp_path / "file").write_bytes(b"")
    monkeypatch.setenv("HLR_CACHE", str(tmp_path / "file"))
    drawing = hlr.draw(ASSEMBLY, strict=True)
    assert "and not kept in the cache (" in drawing.reading
    assert not any("cache" in str(note) for note in drawing.notes)


@pytest.mark.slow
def test_how_a_model_was_come_by_is_no_part_of_the_drawing():
    once, again = hlr.draw(ASSEMBLY), hlr.draw(ASSEMBLY)
    assert once.reading != again.reading
    assert once == again
    assert hash(once) == hash(again)
    assert "cache" not in str(again.to_json()) + again.to_svg()


def test_what_is_recorded_holds_no_path_and_no_time(own_cache, tmp_path):
    facts = [to_entry(open_source(path)) for path in (ASSEMBLY, shutil.copy(ASSEMBLY, tmp_path))]
    assert facts[0] == facts[1]
    assert os.fsencode(str(tmp_path)) not in entry_of(own_cache).read_bytes()
