"""Messages write numbers as people type them: no exponents, no sign before 0, and a limit that is named is allowed."""

import math
import re

import pytest

import hlr
from hlr.common.numbers import typed, typed_below
from hlr.image.paper import misfit
from hlr.image.placement import size_notes
from hlr.request.accuracy import derive
from hlr.tables.sheets import papers
from support.models import box


@pytest.mark.parametrize(
    ("value", "asked", "text"),
    [
        (-2.7e-15, (), "0"),
        (-0.0, (), "0"),
        (0.1 + 0.2, (), "0.3"),
        (66.6, (6, 15), "66.6"),
        (30.0, (), "30"),
        (-1234567.8, (), "-1234570"),
        (26_700_123.0, (3,), "26700000"),
        (0.000022, (2,), "0.000022"),
        (2.1e-12, (2, 15), "0.0000000000021"),
        (2.1e-12, (2,), "0"),
        (0.00049, (6, 3), "0"),
        (12.3456, (6, 3), "12.346"),
        (999.9996, (6,), "1000"),
        (1e15, (), "1e+15"),
        (math.inf, (), "inf"),
        (math.nan, (), "nan"),
    ],
)
def test_a_number_as_it_is_typed(value, asked, text):
    assert typed(value, *asked) == text


@pytest.mark.parametrize(
    ("value", "text"), [(66.68, "66.6"), (0.04999, "0.0499"), (54.0, "54"), (1234.0, "1230"), (0.0, "0")]
)
def test_a_limit_is_never_rounded_up(value, text):
    assert typed_below(value, 3) == text and float(text) <= value


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"accuracy": 1e9}, "accuracy 1000000000 mm is too coarse for a drawing of 2.16 mm: give at most 0.54, or "),
        ({"accuracy": 1e-9}, "accuracy 0.000000001 mm is too fine for a drawing of 2.16 mm: give at least 0.0"),
        ({"scale": 2e9}, "scale 2000000000 cannot be drawn: .* 0.5 or 1:2, from 1:1000000000 to 1000000000:1"),
        ({"scale": -1}, r"scale -1 cannot be drawn: give a positive number or a ratio, 0.5 or 1:2\.$"),
        ({"scale": None, "fit": (1e9, 3)}, "`fit` needs .*, not 1000000000x3"),
        ({"scale": None, "fit": (1e-9, 3)}, "width and height of 0.001 to 10000000 mm, not 0.000000001x3"),
        ({"scale": None, "fit": (1,)}, r"`fit` needs a positive width and height .*, not \(1,\)"),
        ({"scale": None, "fit": (1, 2, 3)}, "`fit` needs a positive width and height .*, not 1x2x3"),
        ({"accuracy": 1e-300}, "accuracy 1e-300 mm is too fine for a drawing of 2.16 mm"),
        ({"scale": 1e-300}, "scale 1e-300 cannot be drawn"),
        ({"window": (1e9, 0, 2e9, 1)}, "four numbers of at most 10000000, not 1000000000,0,2000000000,1"),
        ({"window": (0, -0.0, 1, 1e-9)}, "the window 0,0,1,0.000000001 holds nothing"),
        ({"perspective": hlr.Perspective(eye=(1e13, 0, -0.0))}, "`eye` 10000000000000,0,0 is .* 1000000000000 "),
        ({"perspective": hlr.Perspective(fov=175.0)}, "a field of view of 175 degrees"),
    ],
)  # fmt: skip
def test_refusals(options, message):
    with pytest.raises(hlr.OptionError, match=message):
        hlr.draw(box((1, 1, 1)), **{"scale": 1, "view": "iso"} | options)


@pytest.mark.parametrize(("size", "text"), [((20_000, 20_000), "20000x20000"), ([5], "5"), ("5x5", "'5x5'")])
def test_a_size_is_refused_as_it_is_typed(size, text):
    with pytest.raises(hlr.OptionError, match=f", not {text}."):
        hlr.Style(size=size)


@pytest.mark.parametrize("diagonal", [266.72, 0.9999, 12_345_678.9])
def test_the_accuracy_that_is_named_is_accepted(diagonal):
    for wrong in (1e12, 1e-14):
        with pytest.raises(hlr.OptionError) as refused:
            derive(wrong, 1.0, diagonal, brep=False)
        named = re.search(r"give at (?:most|least) ([\d.]+)", str(refused.value).rstrip("."))[1]
        derive(float(named.rstrip(".")), 1.0, diagonal, brep=False)


def test_notes_on_sizes():
    assert [note.text.partition(" large")[0] for note in size_notes(2.2e-5, 1.0)] == ["the drawing is only 0.000022 mm"]
    assert [note.text.partition(" large")[0] for note in size_notes(2_164_321.0, 1.0)] == ["the drawing is 2160 m"]
    note = misfit((1_414_213.0, 1_632_993.0), 1.0, papers("A4")[0])
    assert note.text.startswith("the drawing, 1414000 x 1633000 mm at 1:1, is too large")


def test_sizes_of_models(capsys):
    from hlr.cli.commands.info import _table
    from hlr.drawing.model_info import ModelInfo

    told = _table(ModelInfo("a.off", "off", 1.0, ((0.0, 0.0, 0.0), (1e-5, 2.5e6, 0.1 + 0.2)), (), ()))
    assert told.splitlines()[0] == "a.off: off, 0.00001 x 2500000 x 0.3 mm"
