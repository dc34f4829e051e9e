"""Plans: which sources there are, and what each file is called."""

import os
import re
from pathlib import Path

import pytest
from batch.models import tetrahedron

from hlr.batch.manifest import manifest_of
from hlr.batch.manifest import read as read_manifest
from hlr.batch.plan import REPORTS, lies_inside, plan
from hlr.batch.report import _WRITERS
from hlr.errors import OptionError


def planned(root, **found):
    """Files of each job of a manifest: its title, and the names."""
    return {
        job.title: [name for row in job.files for name in row]
        for job in plan(manifest_of(found, root), root / "drawings").jobs
    }


def test_all_models_under_a_folder_are_sources(tmp_path):
    for name in ("b.off", "sub/a.off", ".git/c.off", "venv/d.off", "drawings/e.off", "node_modules/f.off"):
        tetrahedron(tmp_path / name)
    (tmp_path / "venv/pyvenv.cfg").touch()
    (tmp_path / "notes.txt").touch()
    found = planned(tmp_path, views="iso")
    assert found == {"b.off": ["b-iso.svg"], "sub/a.off": ["sub/a-iso.svg"]}


def test_scripts_of_a_folder_are_run_only_where_they_show_a_cad_model(tmp_path):
    texts = {
        "part.py": "import cadquery as cq\nresult = cq.Workplane().box(1, 1, 1)\n",
        "shown.py": "from build123d import *\nshow_object(Box(1, 1, 1))\n",
        "helper.py": "import cadquery as cq\ndef box():\n    result = cq.Workplane()\n",
        "setup.py": "result = 1\n",
        "built.py": "import build123d as bd\nwith bd.BuildPart() as part:\n    bd.Box(1, 1, 1)\n",
        "all.py": "from build123d import *\nbox = Box(1, 1, 1)\nshow_all()\n",
        "cells.py": "from build123d import *\n# %%\ndisplay(Box(1, 1, 1))\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    assert list(planned(tmp_path)) == ["all.py", "built.py", "cells.py", "part.py", "shown.py"]
    named = planned(tmp_path, files=["*.py"], exclude=["setup.py", "[ab]*.py"])
    assert list(named) == ["cells.py", "helper.py", "part.py", "shown.py"]

    def silent(**found):
        return [path.name for path in plan(manifest_of(found, tmp_path), tmp_path / "drawings").silent]

    assert silent() == ["helper.py"]
    assert silent(exclude="helper.py") == silent(files="*.py") == silent(files=[".", "helper.py"]) == []
    for name in texts.keys() - {"helper.py", "setup.py"}:
        (tmp_path / name).unlink()
    with pytest.raises(OptionError, match=r"there is no model under .*; scripts that show nothing .*\(helper.py\)"):
        planned(tmp_path)


def test_models_in_the_folder_of_outputs_are_left_out_and_named(tmp_path):
    for name in ("a.off", "out/b.off", "out/c.off", "out/old.off"):
        tetrahedron(tmp_path / name)
    found = plan(
        manifest_of({"files": ["*.off", "out/b.off", "out"], "exclude": "out/old.off"}, tmp_path), tmp_path / "out"
    )
    assert [job.source for job in found.jobs] == ["a.off"]
    assert found.inside == (tmp_path / "out/b.off", tmp_path / "out/c.off")
    assert lies_inside(found) == (
        f"models in the folder of outputs, {tmp_path}/out, are left out (b.off, c.off): give another folder"
    )


def test_patterns_leave_out_what_is_no_model_and_names_do_not(tmp_path):
    for name in ("parts/a.off", "parts/deep/b.off", "c.off"):
        tetrahedron(tmp_path / name)
    (tmp_path / "parts/readme.txt").touch()
    assert list(planned(tmp_path, files="parts/*")) == ["parts/a.off"]
    assert list(planned(tmp_path, files="**/*.off")) == ["c.off", "parts/a.off", "parts/deep/b.off"]
    assert list(planned(tmp_path, files=["c.off", "parts", "c.off"])) == ["c.off", "parts/a.off", "parts/deep/b.off"]
    assert list(planned(tmp_path, files="**/*.off", exclude=["parts/deep"])) == ["c.off", "parts/a.off"]
    assert list(planned(tmp_path, files="parts/readme.txt")) == ["parts/readme.txt"]
    with pytest.raises(OptionError, match=r"prts/\*\.step names no model under"):
        planned(tmp_path, files="prts/*.step")
    with pytest.raises(OptionError, match="there is no model under"):
        planned(tmp_path / "parts/deep/none")
    with pytest.raises(OptionError, match="all models are left out by exclude"):
        planned(tmp_path, files="**/*.off", exclude="*.off")
    with pytest.raises(OptionError, match=r"all models lie in the folder of outputs, .*parts: give another one"):
        plan(manifest_of({"files": "parts"}, tmp_path), tmp_path / "parts")


def test_each_combination_of_parameters_is_a_variant(tmp_path):
    (tmp_path / "a.py").touch()
    found = planned(tmp_path, files="a.py", views=["iso"], parameters={"size": [10, 20.5], "name": "x/y"})
    assert found == {
        "a.py size=10 name=x/y": ["a-size=10,name=x_y-iso.svg"],
        "a.py size=20.5 name=x/y": ["a-size=20.5,name=x_y-iso.svg"],
    }
    found = planned(
        tmp_path, files="a.py", views=["iso", [1, 0, 0]], parameters={"size": [1]}, name="{stem}_{size}_{n}"
    )
    assert found == {"a.py size=1": ["a_1_1.svg", "a_1_2.svg"]}


def test_parameters_are_those_of_the_scripts_among_the_sources(tmp_path):
    tetrahedron(tmp_path / "a.off")
    (tmp_path / "b.py").write_text("result = size")
    size = {"size": [1, 2]}
    variants = ["b.py size=1", "b.py size=2"]
    assert list(planned(tmp_path, files=["a.off", "b.py"], parameters=size)) == ["a.off", *variants]
    # At the top they are for all sources that may have some; a table without a script has no use for them.
    tables = [{"files": "a.off"}, {"files": "b.py"}]
    assert list(planned(tmp_path, parameters=size, source=tables)) == ["a.off", *variants]
    with pytest.raises(OptionError, match="only scripts have parameters, and this names none"):
        planned(tmp_path, source=[{"files": "a.off", "parameters": size}])
    with pytest.raises(OptionError, match="only scripts have parameters, and this names none"):
        planned(tmp_path, files="a.off", parameters=size)


def test_what_sources_depend_on_may_be_any_files(tmp_path):
    tetrahedron(tmp_path / "a.off")
    for name in ("tables/one.csv", "tables/more/two.csv", "look.toml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()

    def depends(*patterns):
        manifest = manifest_of({"files": "a.off", "depends": list(patterns)}, tmp_path)
        return plan(manifest, tmp_path / "drawings").jobs[0].depends

    assert depends() == ()
    assert depends("look.toml", "tables/*.csv") == ("look.toml", "tables/one.csv")
    assert depends("tables", "tables/one.csv") == ("tables/more/two.csv", "tables/one.csv")
    with pytest.raises(OptionError, match=r"tabels/\*\.csv names no file under"):
        depends("tabels/*.csv")


def test_models_that_differ_in_their_ending_only_have_files_of_their_own(tmp_path):
    tetrahedron(tmp_path / "a.off")
    (tmp_path / "a.stl").touch()
    assert planned(tmp_path, views="top") == {"a.off": ["a.off-top.svg"], "a.stl": ["a.stl-top.svg"]}
    (tmp_path / "a.stl").rename(tmp_path / "A.stl")
    assert planned(tmp_path, views="top") == {"A.stl": ["A.stl-top.svg"], "a.off": ["a.off-top.svg"]}


def test_models_that_differ_in_large_letters_only_get_a_number(tmp_path):
    for name in ("A.off", "a.off", "a-2.off"):
        tetrahedron(tmp_path / name)
    if len(list(tmp_path.iterdir())) < 3:
        pytest.skip("this file system takes large and small letters for the same")
    names = {"A.off": ["A-top.svg"], "a-2.off": ["a-2-top.svg"], "a.off": ["a-3-top.svg"]}
    assert planned(tmp_path, views="top") == names
    (tmp_path / "a.stl").touch()
    names |= {"A.off": ["A.off-top.svg"], "a.off": ["a-3.off-top.svg"], "a.stl": ["a.stl-top.svg"]}
    assert planned(tmp_path, views="top") == names
    message = "A.off, top and a.off, top would both be written to a-top.svg, where large and small letters are the same"
    with pytest.raises(OptionError, match=re.escape(message)):
        planned(tmp_path, views="top", files=["A.off", "a.off"], name="{stem}-{view}")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("{stem}", "a.off, front and a.off, top would both be written to a.svg"),
        ("{stem}-{size}", "there is no field {size}: use {folder}, {stem}"),
        ("../{stem}-{view}", "../a-front leads out of the folder of outputs"),
        ("/tmp/{view}", "/tmp/front leads out of the folder of outputs"),
    ],
)
def test_names_that_cannot_be(tmp_path, name, message):
    tetrahedron(tmp_path / "a.off")
    with pytest.raises(OptionError, match=re.escape(message)):
        planned(tmp_path, name=name, views=["front", "top"])


def test_what_is_named_twice_is_told_as_that(tmp_path):
    tetrahedron(tmp_path / "a.off")
    with pytest.raises(OptionError, match=r"^the view top is given twice: give it once, or put \{n\} into the name"):
        planned(tmp_path, views=["top", "iso", "top"])
    assert len(planned(tmp_path, views=["top", "top"], name="{stem}-{n}")["a.off"]) == 2
    sources = [{"files": "a.off"}, {"files": "*.off", "scale": 2.0}]
    with pytest.raises(OptionError, match=r"^a\.off is named twice: leave it out of one \[\[source\]\], or give that"):
        planned(tmp_path, source=sources)


def test_a_drawing_does_not_take_the_place_of_what_drawings_depend_on(tmp_path):
    tetrahedron(tmp_path / "a.off")
    (tmp_path / "out").mkdir()
    (tmp_path / "out/sheet.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm"/>')
    for more in ({"arrange": "first-angle", "template": "out/sheet.svg"}, {"views": "top", "depends": "out/sheet.svg"}):
        found = manifest_of({"name": "sheet", **more}, tmp_path)
        with pytest.raises(
            OptionError, match=r"^a\.off, .* would be written to sheet\.svg, which a drawing depends on: "
        ):
            plan(found, tmp_path / "out")
        assert len(plan(found, tmp_path / "other").jobs) == 1


@pytest.mark.parametrize("link", [os.symlink, os.link])
@pytest.mark.parametrize("read", ["a.obj", "paint.mtl", "wood.png", "my.toml", "notes.txt", "hlr.toml"])
def test_no_drawing_is_written_through_a_link_to_what_is_read(tmp_path, link, read):
    (tmp_path / "a.obj").write_text("mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "paint.mtl").write_text("newmtl a\nmap_Kd wood.png\n")
    for name in ("wood.png", "my.toml", "notes.txt"):
        (tmp_path / name).write_text("")
    (tmp_path / "hlr.toml").write_text('views = "top"\nname = "{stem}"\nstyle = "my.toml"\ndepends = "notes.txt"\n')
    (tmp_path / "out").mkdir()
    link(tmp_path / read, tmp_path / "out/a.svg")
    with pytest.raises(
        OptionError, match=r"a\.obj, top would be written to a\.svg, which a drawing depends on: choose"
    ):
        plan(read_manifest(tmp_path / "hlr.toml"), tmp_path / "out")
    assert len(plan(read_manifest(tmp_path / "hlr.toml"), tmp_path / "other").jobs) == 1


def test_a_texture_is_not_drawn_over(tmp_path):
    (tmp_path / "a.obj").write_text("mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "paint.mtl").write_text("newmtl a\nmap_Kd out/a-top.png\n")
    (tmp_path / "out").mkdir()
    (tmp_path / "out/a-top.png").write_bytes(b"wood")
    with pytest.raises(OptionError, match="which a drawing depends on"):
        plan(manifest_of({"files": "a.obj", "views": "top", "formats": "png"}, tmp_path), tmp_path / "out")


@pytest.mark.parametrize("report", [*REPORTS, "index.html"])
def test_the_report_does_not_take_the_place_of_what_drawings_depend_on(tmp_path, report):
    tetrahedron(tmp_path / "a.off")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / report).write_text("")
    found = manifest_of({"views": "top", "depends": f"out/{report}"}, tmp_path)
    with pytest.raises(
        OptionError, match=r"^the report would be written to .*, which a drawing depends on: name anoth"
    ):
        plan(found, tmp_path / "out")


def test_a_drawing_does_not_take_a_file_of_the_report(tmp_path):
    tetrahedron(tmp_path / "a.off")
    with pytest.raises(OptionError, match=r"the report and a\.off, iso would both be written to Manifest\.json"):
        planned(tmp_path, name="Manifest", formats="json", views="iso")
    assert tuple(_WRITERS) == REPORTS


def test_a_source_outside_the_root_is_drawn_inside_the_folder(tmp_path):
    tetrahedron(tmp_path / "other/a.off")
    (tmp_path / "here").mkdir()
    found = planned(tmp_path / "here", files="../other/*.off", views="iso")
    assert found == {"../other/a.off": ["other/a-iso.svg"]}
    assert Path(tmp_path / "here/drawings" / "other/a-iso.svg").is_relative_to(tmp_path / "here/drawings")
