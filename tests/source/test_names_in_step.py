"""Names in STEP files: as they were given, also where CadQuery or build123d has encoded them twice."""

import cadquery as cq
import pytest

import hlr

NAMES = ["Größe Ä", "Болт М8", "螺栓", "مسمار", "Čep", "🔩 1"]
"""Of these some have bytes that are spaces where they are taken for characters."""


def written(tmp_path, names):
    """A STEP file as CadQuery writes it."""
    assembly = cq.Assembly(name="Getriebegehäuse")
    for k, name in enumerate(names):
        assembly.add(cq.Workplane().box(1 + k, 1, 1), name=name, loc=cq.Location((9 * k, 0, 0)))
    assembly.export(str(tmp_path / "parts.step"))
    return tmp_path / "parts.step"


def test_names_that_cadquery_encodes_twice_are_read(tmp_path):
    path = written(tmp_path, NAMES)
    assert [part.name for part in hlr.info(path).parts] == NAMES
    drawing = hlr.draw(path, view="front", only=["螺栓", "Größe*"])
    assert [part.name for part in drawing.parts] == ["Größe Ä", "螺栓"]


@pytest.mark.parametrize("name", ["Größe", "Ã", "naïve façade", "Ø 8 µm ±", "Болт", "Ã©Ω"])
@pytest.mark.parametrize("encoded", ["utf-8", "X2"])
def test_names_that_are_encoded_once_stay(name, encoded, tmp_path):
    path = written(tmp_path, ["plain-name"])
    units = name.encode("utf-16-be").hex().upper()
    text = name if encoded == "utf-8" else f"\\X2\\{units}\\X0\\"
    path.write_bytes(path.read_bytes().replace(b"plain-name", text.encode()))
    assert [part.name for part in hlr.info(path).parts] == [name]
