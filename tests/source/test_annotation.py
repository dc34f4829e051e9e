"""Faces of annotation in STEP files: left out with a remark where the file hides them or calls them supplemental."""

import re

import cadquery as cq
import pytest
from cadquery import exporters

import hlr
from hlr.source import open_source
from support.at_size import AT_SIZE

BODY, SHEET = 6, 1
"""Faces."""


def sheet(z=10.0):
    return cq.Shell.makeShell([cq.Face.makePlane(6, 6, (0, 0, z))])


def written(path, *shapes, extra=""):
    """A STEP file of the shapes as one product; extra: lines with {shell} and the like for its numbers."""
    exporters.export(cq.Workplane(cq.Compound.makeCompound(shapes)), str(path), exporters.ExportTypes.STEP)
    text = path.read_text()
    numbers = {
        word: re.findall(rf"#(\d+) *= *{name} *\(", text)[-1]
        for word, name in (("model", "SHELL_BASED_SURFACE_MODEL"), ("shell", "OPEN_SHELL"), ("face", "ADVANCED_FACE"))
        if f"{{{word}}}" in extra
    }
    numbers["context"] = re.findall(r"#(\d+) *= *\( *GEOMETRIC_REPRESENTATION_CONTEXT\(3\)", text)[-1]
    at = text.rindex("ENDSEC;")
    path.write_text(text[:at] + extra.format(**numbers) + text[at:])
    return path


def hidden(what):
    return (
        f"#90001=STYLED_ITEM('',(#90002),#{{{what}}});\n#90002=PRESENTATION_STYLE_ASSIGNMENT((#90003));\n"
        "#90003=SURFACE_STYLE_USAGE(.BOTH.,#90004);\n#90004=SURFACE_SIDE_STYLE('',());\n"
        "#90005=INVISIBILITY((#90001));\n"
    )


def on_a_hidden_layer(what):
    return f"#90001=PRESENTATION_LAYER_ASSIGNMENT('7','',(#{{{what}}}));\n#90002=INVISIBILITY((#90001));\n"


def supplemental(what):
    return f"#90001=CONSTRUCTIVE_GEOMETRY_REPRESENTATION('supplemental geometry',(#{{{what}}}),#{{context}});\n"


def faces(source):
    return sum(info.faces for info in source.infos())


WAYS = [way(what) for way in (hidden, on_a_hidden_layer, supplemental) for what in ("model", "shell")] + [
    hidden("face")
]


@pytest.mark.parametrize("extra", WAYS)
def test_left_out_with_a_remark(tmp_path, extra):
    path = written(tmp_path / "part.step", cq.Workplane().box(10, 8, 4).val(), sheet(), extra=extra)
    source = open_source(path)
    assert faces(source) == BODY and source.bounds()[1, 2] < 2.1
    (note,) = source.notes
    assert note.code == "annotation-left-out" and not note.is_warning
    assert str(note).startswith("1 face of annotation, hidden or supplemental in the file, left out: --annotations")
    source = open_source(path, annotations=True)
    assert faces(source) == BODY + SHEET and source.notes == []


def test_drawing_preview_plan_and_info_agree(tmp_path):
    path = written(tmp_path / "part.step", cq.Workplane().box(10, 8, 4).val(), sheet(), extra=hidden("shell"))
    for asked, parts in (({}, 1), ({"annotations": True}, 2)):
        drawing = hlr.draw(path, strict=True, **AT_SIZE | asked) if not asked else hlr.draw(path, **AT_SIZE | asked)
        assert len(drawing.parts) == len(hlr.preview(path, size=(20, 20), **asked).parts) == parts
        assert len(hlr.info(path, **asked).parts) == parts
        assert ("annotation-left-out" in [note.code for note in drawing.notes]) == (parts == 1)
    with pytest.raises(hlr.OptionError, match="annotations is yes or no"):
        hlr.draw(path, annotations="yes", **AT_SIZE)


def test_sheets_that_nothing_hides_are_drawn(tmp_path):
    path = written(tmp_path / "part.step", cq.Workplane().box(10, 8, 4).val(), sheet())
    assert faces(open_source(path)) == BODY + SHEET
    # Of two sheets the hidden one alone is left out.
    path = written(tmp_path / "two.step", sheet(0.0), sheet(5.0), extra=hidden("shell"))
    source = open_source(path)
    assert faces(source) == SHEET and source.bounds()[1, 2] < 0.1


def test_a_file_of_nothing_else_is_drawn_whole(tmp_path):
    source = open_source(written(tmp_path / "part.step", sheet(), extra=hidden("shell")))
    assert faces(source) == SHEET and source.notes == []


def test_a_hidden_solid_stays(tmp_path):
    path = tmp_path / "part.step"
    exporters.export(cq.Workplane().box(10, 8, 4), str(path), exporters.ExportTypes.STEP)
    text = path.read_text()
    solid = re.findall(r"#(\d+) *= *MANIFOLD_SOLID_BREP", text)[0]
    at = text.rindex("ENDSEC;")
    path.write_text(text[:at] + hidden("solid").format(solid=solid) + text[at:])
    assert faces(open_source(path)) == BODY
