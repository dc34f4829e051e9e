"""Each property of a style reaches SVG, PDF and PNG."""

import io
import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from writers.pages import content_of, image

import hlr
from hlr.drawing.fill import Fill
from hlr.request.check import checked
from hlr.request.styles import STYLES
from hlr.writers.drawing_png import drawing_png
from hlr.writers.fill import painted
from hlr.writers.pdf import pdf
from hlr.writers.svg import svg
from support.drawings import drawing, line, part, sample

S, INKSCAPE = "{http://www.w3.org/2000/svg}", "{http://www.inkscape.org/namespaces/inkscape}"


def cross():
    """A visible line of one part, and a hidden one of another, whose name is an attack."""
    lines = [line([[0, 0], [40, 0]], edge=1), line([[0, 10], [40, 10]], visible=False, part=1, edge=2)]
    return drawing(lines, parts=[part("plate", (0.0, 1.0, 0.0)), part('bolt"/><script>:1', (1.0, 0.0, 0.0))])


def pixels(made):
    return np.asarray(Image.open(io.BytesIO(drawing_png(made))).convert("RGBA"))


def inks(made):
    """For each part: stroke, width, cap and number of dashes of its only line in the SVG, as its groups say them."""
    found = {}

    def visit(element, around):
        own = {**around, **element.attrib}
        if element.tag == f"{S}path":
            dashes = len(own.get("stroke-dasharray", "").split())
            found[int(own["data-part"])] = (own["stroke"], own["stroke-width"], own["stroke-linecap"], dashes)
        for child in element:
            visit(child, own)

    visit(ET.fromstring(svg(made)), {})
    return found


def commands(made):
    """The same of the PDF, in the order of drawing: colour, width, cap."""
    return re.findall(r"BDC (\S+ \S+ \S+) RG (\S+) w (\d) J", content_of(pdf(made)))


def test_widths_colours_dashes_and_caps_reach_svg_and_pdf():
    look = {
        "visible": {"width": 0.9, "color": "#ff0000", "cap": "square"},
        "hidden": {"sharp": {"width": 0.1, "color": "blue", "dash": []}},
    }
    made = cross().with_style(look)
    assert inks(made) == {0: ("#ff0000", ".9", "square", 0), 1: ("#0000ff", ".1", "round", 0)}
    assert commands(made) == [("0 0 1", ".1", "1"), ("1 0 0", ".9", "2")]
    assert inks(cross())[1] == ("#000000", ".25", "butt", 2)


def test_patterns_of_parts_choose_their_pens():
    made = cross().with_style({"parts": {"BOLT*": {"color": "teal", "hidden": {"width": 0.13}}}})
    assert inks(made) == {0: ("#000000", ".5", "round", 0), 1: ("#008080", ".13", "butt", 2)}
    assert commands(made) == [("0 .502 .502", ".13", "0"), ("0 0 0", ".5", "1")]


def test_lines_of_other_parts_are_the_same_where_one_has_its_own_pen():
    made = sample()
    paths = re.findall(rb"<(?:path|circle) [^>]*>", svg(made))
    styled = re.findall(rb"<(?:path|circle) [^>]*>", svg(made.with_style({"parts": {"box": {"color": "red"}}})))
    assert sorted(paths) == sorted(styled)


def test_parts_have_their_own_colours_on_request_and_can_be_read():
    made = cross().with_style({"part-colors": "lines"})
    assert inks(made)[1][0] == "#ff0000"
    green = inks(made)[0][0]
    assert green != "#00ff00" and green[1:3] == green[5:7] == "00"  # pure green on white is too bright
    assert inks(made.with_style({"base": "dark", "part-colors": "lines"}))[0][0] == "#00ff00"


def test_parts_are_painted_flat_in_their_own_colours():
    corners = np.array([[0.0, 0.0], [40.0, 0.0], [40.0, 20.0], [0.0, 20.0]])
    shaded = np.array([[10, 20, 30, 255]], np.uint8)
    whole = np.array([0, 1], np.int32)
    fill = Fill(corners, np.array([0, 4], np.int32), whole, shaded, np.array([-1], np.int32), (), whole[1:], 0.1)
    made = replace(cross(), fill=fill)
    assert b'fill="#0a141e"' in svg(made)
    flat = made.with_style({"part-colors": "fills"})
    assert b'fill="#ff0000" stroke="#ff0000"' in svg(flat)
    assert "1 0 0 rg 1 0 0 RG" in content_of(pdf(flat))
    assert pixels(flat)[83, 200].tolist() == [255, 0, 0, 255]


def test_a_transparent_part_is_painted_alike_before_paper_and_before_another_part():
    """Where something is behind it, its shaded colour holds that and is opaque; elsewhere it is not."""
    corners = np.array([[x, y] for x in (0.0, 20.0) for x, y in ((x, 0.0), (x + 20.0, 0.0), (x + 20.0, 20.0))])
    shaded = np.array([[90, 40, 60, 255], [255, 0, 0, 102]], np.uint8)
    starts, own = np.array([0, 1, 2], np.int32), np.array([1, 1], np.int32)
    fill = Fill(corners, 3 * starts, starts, shaded, np.array([-1, -1], np.int32), (), own, 0.1)
    flat = replace(cross(), fill=fill).with_style({"part-colors": "fills"})
    assert painted(flat, fill).colors.tolist() == [[255, 0, 0, 255]] * 2
    assert b"fill-opacity" not in svg(flat)
    assert " gs" not in content_of(pdf(flat))
    assert "ExtGState" not in pdf(flat).decode("latin-1")


def test_a_style_that_wants_the_colours_of_parts_has_faces_painted():
    assert checked(hlr.Options(style={"part-colors": "fills"})).fill
    assert not checked(hlr.Options(style={"part-colors": "lines"})).fill


@pytest.mark.parametrize(("name", "expected"), [("iso", "#ffffff"), ("dark", "#1e1e1e"), ("blueprint", "#1b4a8a")])
def test_the_background_reaches_every_file(name, expected):
    made = cross().with_style(name)
    root = ET.fromstring(svg(made))
    assert root.get("style") == f"background:{expected}"
    assert not root.findall(f".//{S}rect")  # a laser would cut it
    corner = [int(expected[i : i + 2], 16) for i in (1, 3, 5)]
    assert pixels(made)[0, 0].tolist() == [*corner, 255]
    assert ("re f" in content_of(pdf(made))) == (name != "iso")
    assert abs(image(made)[0, 0] - np.dot(corner, [0.299, 0.587, 0.114])) < 2


def test_without_a_background_what_lies_below_shows():
    made = cross().with_style({"background": "none"})
    assert "style" not in ET.fromstring(svg(made)).attrib
    found = pixels(made)
    assert found[0, 0, 3] == 0 and found[:, :, 3].max() == 255


def test_current_color_is_that_of_the_text_around_in_svg_and_black_elsewhere():
    made = cross().with_style({"lines": {"color": "currentcolor"}})
    assert {ink[0] for ink in inks(made).values()} == {"currentColor"}
    assert {command[0] for command in commands(made)} == {"0 0 0"}


def layers(element):
    """The tree of layers as Inkscape lists them."""
    return [
        (child.get(f"{INKSCAPE}label"), layers(child))
        for child in element
        if child.get(f"{INKSCAPE}groupmode") == "layer"
    ]


def test_layers_are_by_class_or_first_by_part():
    root = ET.fromstring(svg(cross()))
    assert layers(root) == [("Hidden", [("Hidden sharp", [])]), ("Visible", [("Visible sharp", [])])]
    root = ET.fromstring(svg(cross().with_style({"layers": "part"})))
    assert layers(root) == [
        ("plate", [("Visible", [("Visible sharp", [])])]),
        ('bolt"/><script>:1', [("Hidden", [("Hidden sharp", [])])]),
    ]
    data = pdf(cross().with_style({"layers": "part"}))
    assert re.findall(rb"/Type /OCG/Name \(([^)]*)\)", data) == [
        b"plate", b"Visible sharp", b'bolt"/><script>:1', b"Hidden sharp",
    ]  # fmt: skip
    assert content_of(data).count("BDC") == content_of(data).count("EMC") == 4


def test_what_people_style_with_css_is_there():
    made = cross().with_style({"parts": {"plate": {"width": 1}}})
    root = ET.fromstring(svg(made))
    assert root.find(f"{S}g[@id='hidden']") is not None
    visible = root.find(f"{S}g[@id='visible']")
    # The class is on the group that has the width: a rule for the class overrides it.
    (own,) = [group for group in visible.iter(f"{S}g") if group.get("stroke-width") == "1"]
    assert own.get("class") == "sharp" and own.find(f"{S}g[@data-part='0']") is not None


def test_nothing_of_a_name_or_colour_leaves_its_quotes():
    for style in ("iso", {"layers": "part"}, {"parts": {'bolt"*': {"color": "red"}}}):
        root = ET.fromstring(svg(cross().with_style(style)))
        assert not [element for element in root.iter() if "script" in element.tag]
    for color in (
        '"/><script>',
        "red;background:url(x)",
        "url(#a)",
        "rgba(0,0,0,.5)",
        "#12345g",
        "\N{FULLWIDTH DIGIT ONE}",
    ):
        with pytest.raises(hlr.OptionError, match="needs a colour"):
            hlr.LineRule(color=color)
        with pytest.raises(hlr.OptionError, match="needs a colour"):
            hlr.Style(background=color)


def test_a_description_tells_what_is_drawn():
    text = ET.fromstring(svg(cross())).find(f"{S}desc").text
    assert text.startswith("Hidden-line drawing of box.step: view iso") and "1 visible line and 1 hidden line." in text


@pytest.mark.parametrize("name", STYLES)
def test_a_style_goes_through_json(tmp_path, name):
    made = sample().with_style(name)
    assert hlr.load(made.save(tmp_path / "a.json")) == made
    assert ('"style"' in made.to_json()) == (name != "iso")


def test_a_damaged_style_in_json_is_refused(tmp_path):
    path = sample().with_style("dark").save(tmp_path / "a.json")
    path.write_text(path.read_text().replace('"#1e1e1e"', '"\\"/><script>"'))
    with pytest.raises(hlr.SourceError, match=r"a\.json is damaged: style: background needs a colour"):
        hlr.load(path)
