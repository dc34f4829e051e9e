"""Styles as people write them: what a file may say, and the sentence for what it may not."""

import pytest

import hlr
from hlr.drawing.pens import usual_pens
from hlr.request.check import checked
from hlr.request.style_file import LARGEST, overridden, style_of
from hlr.request.styles import STYLES

WHOLE = """
base = "dark"
wide = 0.35
background = "none"
layers = "part"
part-colors = "lines"
dpi = 300
dxf = "R12"

[visible]
color = "red"
[visible.smooth]
width = 0.1
[hidden]
dash = []
[lines]
cap = "square"
[parts."bolt*"]
color = "blue"
[parts."bolt*".hidden.sharp]
width = "wide"
"""


def test_a_file_says_what_differs_from_its_base(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(WHOLE)
    style = style_of(str(path))
    assert (style.background, style.layers, style.part_colors, style.dpi, style.dxf) == (
        None,
        "part",
        "lines",
        300,
        "R12",
    )
    pens = usual_pens(style)
    sharp, smooth, hidden = pens.pen("sharp", True), pens.pen("smooth", True), pens.pen("sharp", False)
    assert (sharp.width, sharp.color, sharp.cap) == (0.35, "#ff0000", "square")
    assert (smooth.width, hidden.width, hidden.dash) == (0.1, 0.175, None)
    assert hidden.color == usual_pens(STYLES["dark"]).pen("sharp", False).color
    assert [rule.scope for rule in style.lines[-2:]] == [("bolt*", None, None), ("bolt*", False, "sharp")]


def test_names_paths_tables_and_records_are_styles(tmp_path):
    assert style_of(None) == style_of("ISO") == style_of({}) == hlr.Style() == STYLES["iso"]
    assert style_of({"base": "thin"}) == STYLES["thin"]
    (tmp_path / "a.TOML").write_text('base = "asme"')
    assert style_of(tmp_path / "a.TOML") == STYLES["asme"]
    assert checked(hlr.Options(style="dark")).style == STYLES["dark"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("wide = ", "the style own.toml is no TOML: "),
        ("wide = -1", "the style own.toml: wide needs millimetres, 0.01 to 100, not -1."),
        ("wide = true", "wide needs millimetres"),
        ("wide = nan", "wide needs millimetres"),
        ("bakground = 'red'", "there is no key 'bakground': did you mean background?"),
        ("background = 'reddish'", "background needs a colour such as white or #1a2b3c, or none, not 'reddish'."),
        ("background = '\"/><script>alert(1)</script>'", "background needs a colour"),
        ("base = 'din'", "base is iso, asme, thin, dark or blueprint, not 'din'."),
        ("layers = 'colour'", "layers is class or part, not 'colour'."),
        ("part-colors = 1", "part_colors is lines or fills, not 1."),
        ("dxf = 'R13'", "dxf is R12, R2000,"),
        ("dpi = 0", "dpi needs pixels per inch, 1 to 10000, not 0."),
        ("size = [1, 2, 3]", "size needs a width and height in pixels"),
        ("size = [800, 600]\ndpi = 100", "size and dpi contradict one another"),
        ("visible = 'red'", "visible is a table, such as [visible], not 'red'."),
        ("[visible]\ncolour = 'red'", "in [visible] there is no key 'colour': did you mean color?"),
        ("[visible.sharpp]\ncolor = 'red'", "in [visible] there is no key 'sharpp': did you mean sharp?"),
        ("[visible.sharp.smooth]\ncolor = 'red'", "in [visible.sharp] there is no key 'smooth': use width"),
        ("[hidden.sharp]\ncolor = 'url(#a)'", "[hidden.sharp]: color needs a colour such as black"),
        ("[hidden]\ndash = [1, 2]", "[hidden]: dash needs a dash and a gap in multiples"),
        ("[hidden]\ncap = 'flat'", "[hidden]: cap is round, butt or square, not 'flat'."),
        ("[lines]\nwidth = 'thick'", "[lines]: width needs millimetres, 0.01 to 100, wide or narrow, not 'thick'."),
        ("[parts.nut.lines]\ncolor = 'red'", "in [parts.\"nut\"] there is no key 'lines'"),
        ("#" * (LARGEST + 1), "is larger than 100 kB"),
        ("\n".join(f"[parts.p{i}]\ncap = 'butt'" for i in range(1001)), "has 1001 rules for lines: 1000 are the most"),
        ("a" + ".a" * 40000 + " = 1", "line 1 has more than 1000 points"),
    ],
)
def test_a_wrong_file_gets_one_sentence_that_names_it(tmp_path, text, said):
    path = tmp_path / "own.toml"
    path.write_text(text)
    with pytest.raises(hlr.OptionError) as caught:
        style_of(path)
    message = str(caught.value)
    assert said in message and "own.toml" in message and "\n" not in message


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("darc", "there is no style 'darc': give iso, asme, thin, dark or blueprint, or a file that ends in .toml."),
        ("none.toml", "the style none.toml cannot be read: No such file or directory."),
        ("\0.toml", "cannot be read"),
        (7, "style needs iso"),
        (["dark"], "style needs iso"),
    ],
)
def test_what_is_no_style_is_refused(asked, said):
    with pytest.raises(hlr.OptionError) as caught:
        checked(hlr.Options(style=asked))
    assert said in str(caught.value)


def test_a_file_with_another_ending_is_told_so(tmp_path):
    (tmp_path / "own.style").write_text("[lines]\ncap = 'butt'")
    with pytest.raises(hlr.OptionError, match=r"own\.style is a file that does not end in \.toml: rename it"):
        style_of(tmp_path / "own.style")


def test_a_file_that_is_no_text_is_refused(tmp_path):
    path = tmp_path / "own.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(hlr.OptionError, match=r"own\.toml is no text in UTF-8"):
        style_of(path)


def test_single_values_override_all_that_a_style_says_about_them():
    own = {
        "visible": {"color": "red", "sharp": {"color": "green", "width": 0.9}},
        "hidden": {"smooth": {"color": "navy"}},
        "parts": {"nut": {"color": "gold"}},
    }
    changed = overridden(style_of(own), line_width=0.4, color="#123456", background="black")
    pens = usual_pens(changed)
    kinds = [(kind, visible) for kind in ("sharp", "smooth") for visible in (True, False)]
    assert {pens.pen(*each).color for each in kinds} == {"#123456"}
    assert [pens.pen(*each).width for each in kinds] == [0.4, 0.2, 0.2, 0.2]
    assert changed.background == "#000000" and not any(rule.color for rule in changed.lines if rule.parts)


def test_a_colour_of_hidden_lines_leaves_visible_ones_as_they_are():
    own = {"lines": {"sharp": {"color": "green"}}, "hidden": {"smooth": {"color": "navy"}}}
    pens = usual_pens(overridden(style_of(own), hidden_color="silver"))
    found = [pens.pen(kind, visible).color for kind in ("sharp", "smooth") for visible in (True, False)]
    assert found == ["#008000", "#c0c0c0", "#000000", "#c0c0c0"]


def test_lines_are_wider_on_sheets_larger_than_a2():
    for sheet, widths in (((594, 420), (0.5, 0.25)), ((420, 594), (0.5, 0.25)), ((594, 841), (0.7, 0.35))):
        pens = usual_pens(STYLES["iso"], sheet)
        assert (pens.pen("sharp", True).width, pens.pen("sharp", False).width) == widths
    assert usual_pens(STYLES["asme"], (841, 1189)).wide == 0.6
