"""The effects of a drawing, in the order in which they are decided: the table that `hlr draw --explain` prints.

The table imports no stage, so that every stage can ask it.
"""

from __future__ import annotations

from collections.abc import Mapping

from hlr.request.effect import ASKED, SCENE, Answer, Effect, Facts
from hlr.request.options import Options
from hlr.tables.line_classes import LINE_CLASSES, LineClass, counted
from hlr.tables.readers import holds_meshes, is_brep, of_kind

DEEP_GROUPS, DEEP_EDGES = 400, 8000
"""With fewer surfaces or edges the depth pyramid costs more than it saves: measured (`hlr/request/README.md`)."""

LEGIBILITY = "legibility"
"""The row of what the pen can show."""


def _count(number: int, what: str, plural: str = "") -> str:
    return f"{number:,} {what if number == 1 else plural or what + 's'}"


def _option_effect(option: str, title: str, counter: str, off: str = "not asked for") -> Effect:
    """An effect that an option alone decides."""

    def needed(_facts: Facts, options: Options) -> Answer:
        return (True, "asked for") if getattr(options, option) else (False, off)

    return Effect(title, ASKED, needed, (counter,))


def _view_effect(option: str, title: str, counter: str, usual: bool, off: str = "") -> Effect:
    """An effect that an option decides, or, where that is left open, the kind of view.

    usual: whether pictorial views have it; off: what it means that it is off.
    """

    def needed(f: Facts, options: Options) -> Answer:
        asked: bool | None = getattr(options, option)
        kind = "a pictorial view" if f.pictorial else "a view along an axis"
        on = f.pictorial is usual if asked is None else bool(asked)
        why = kind if asked is None else "asked for" if asked else "not asked for"
        return on, why if on else f"{why}{off}"

    return Effect(title, ASKED, needed, (counter,))


def _lines_of(row: LineClass) -> Effect:
    """Lines of one class."""
    counter = str(row.counter)
    if row.option is not None and row.by_default is None:
        return _view_effect(row.option, row.title, counter, True)
    if row.option is not None:
        return _option_effect(row.option, row.title, counter)
    return Effect(row.title, ASKED, lambda _facts, _options: (True, "drawn in every drawing"), (counter,))


def _noun(kind: str) -> str:
    """A source of this kind, for people."""
    reader = of_kind(kind)
    return reader.noun if reader is not None and reader.noun else f"a mesh ({kind})"


def _brep(f: Facts, _o: Options) -> Answer:
    return is_brep(f.kind), f"the source is {_noun(f.kind)}"


def _mesh(f: Facts, _o: Options) -> Answer:
    return holds_meshes(f.kind), f"the source is {_noun(f.kind)}"


def _fine(f: Facts, options: Options) -> Answer:
    if not f.sphere:
        return True, "what is hidden, and where edges end, is found on the mesh"
    if f.perspective:
        return True, "an eye may see less of a sphere than a coarse triangle holds"
    if options.fill or options.seam or options.fit is not None or options.window is not None:
        return True, "fill, seams, a size to fit into and a window need more than the outline"
    return False, "one sphere: its outline is the only line, and is computed on the surface itself"


def _touching(f: Facts, options: Options) -> Answer:
    if not f.faces:
        return False, "a mesh is drawn as it is"
    if f.touching and options.fill:
        return True, "the light on filled faces changes from triangle to triangle"
    if f.touching and f.parts > 1:
        return True, f"{_count(f.touching, 'part')} may touch others{' or themselves' if f.through else ''}"
    if f.touching:
        return True, "its surface passes through itself" if f.through else "its faces are not one solid"
    return False, "no part comes near another" if f.parts > 1 else "one solid touches no other"


def _curved(f: Facts, _o: Options) -> Answer:
    if not f.faces:
        return False, "a mesh is drawn as it is"
    return f.curved > 0, _count(f.curved, "curved face") if f.curved else "all faces are planar"


def _planar(f: Facts, _o: Options) -> Answer:
    if not f.faces:
        return False, "a mesh is drawn as it is"
    return f.planar > 0, _count(f.planar, "planar face") if f.planar else "all faces are curved"


def _rescue(f: Facts, _o: Options) -> Answer:
    if not f.faces:
        return False, "a mesh has no faces to be meshed"
    if not f.failed:
        return False, "the kernel has meshed every face"
    return True, f"the kernel could not mesh {_count(f.failed, 'face')}: OpenCASCADE tries"


def _repair(f: Facts, _o: Options) -> Answer:
    return f.repeated, "triangles are there twice" if f.repeated else "no triangle is there twice"


def _stitching(f: Facts, _o: Options) -> Answer:
    return f.borders > 0, f"meshes have {_count(f.borders, 'border')}" if f.borders else "no mesh has a border"


def _clash(f: Facts, _o: Options) -> Answer:
    if f.meeting:
        return True, f"the boxes of {_count(f.meeting, 'surface')} meet"
    if f.folded:
        return True, f"{_count(f.folded, 'surface')} may pass through itself" if f.folded == 1 else (
            f"{_count(f.folded, 'surface')} may pass through themselves"
        )
    return False, "all surfaces are convex bodies, and their boxes lie apart"


def _outlines(f: Facts, _o: Options) -> Answer:
    if f.curved:
        return True, f"{_count(f.curved, 'curved face')} may show one"
    return False, "a planar face has none" if f.faces else "a mesh has no surfaces but its triangles"


def _near(f: Facts, _o: Options) -> Answer:
    if not f.perspective:
        return False, "a parallel view has no near plane"
    return f.crossed > 0, "something lies behind the near plane" if f.crossed else "all lies before the near plane"


def _sides(f: Facts, _o: Options) -> Answer:
    if not f.perspective:
        return False, "a parallel view has no frame"
    if f.crossed:
        return True, f"something lies beyond {_count(f.crossed, 'side')} of the frame"
    return False, "all lies within the frame"


def _divide(f: Facts, _o: Options) -> Answer:
    return f.perspective, "the camera has an eye" if f.perspective else "a parallel view: nothing is magnified"


def _culling(f: Facts, _o: Options) -> Answer:
    if f.culled:
        return True, f"{_count(f.culled, 'surface')} of {f.groups:,} closed and turned outward"
    return False, "no surface is closed and turned outward"


def _crossings(f: Facts, _o: Options) -> Answer:
    if f.convex:
        return False, "one convex body: its faces lie side by side in the image, and culling alone decides"
    return (
        True,
        f"{_count(f.groups, 'surface')} may hide one another" if f.groups > 1 else "the surface may hide itself",
    )


def _piercings(f: Facts, _o: Options) -> Answer:
    if f.convex:
        return False, "one convex body does not pass through itself"
    if f.unsound:
        return True, f"{_count(f.unsound, 'surface')} may pass through others or itself: not vouched for by a B-rep"
    if f.meeting:
        return True, f"the boxes of {_count(f.meeting, 'surface')} come near others"
    return False, "every surface is sound, and their boxes lie apart"


def _contact(f: Facts, _o: Options) -> Answer:
    if f.unsound:
        return True, f"{_count(f.unsound, 'surface')} may touch others or itself: neither closed nor vouched for"
    if f.meeting:
        return True, f"the boxes of {_count(f.meeting, 'surface')} come within the tolerance of others"
    return False, "nothing is near enough to touch"


def _pyramid(f: Facts, _o: Options) -> Answer:
    deep = f.groups >= DEEP_GROUPS and f.edges >= DEEP_EDGES
    what = f"{_count(f.groups, 'surface')} and {_count(f.edges, 'edge')}"
    return deep, f"{what}: much may lie behind" if deep else f"{what}: looking would cost more than it saves"


def _section(f: Facts, _o: Options) -> Answer:
    return True, f"asked for: its plane cuts {_count(f.cut, 'part')}"


def _glass(f: Facts, options: Options) -> Answer:
    if f.opacity >= 1.0:
        return False, "all is opaque"
    least = f"the least opacity is {f.opacity:g}"
    return (
        options.see_through,
        f"asked for: {least}" if options.see_through else f"{least}, and still hides: not asked for",
    )


def _exact(f: Facts, _o: Options) -> Answer:
    return f.bent > 0, f"{_count(f.bent, 'line')} may be curved" if f.bent else "every line is straight, or a mesh's"


def _legibility(_f: Facts, options: Options) -> Answer:
    return not options.details, "all details were asked for" if options.details else "not all details were asked for"


def _window(f: Facts, options: Options) -> Answer:
    if options.window is None:
        return False, "no window was asked for"
    if f.crossed:
        return True, f"something lies beyond {_count(f.crossed, 'side')} of the window"
    return False, "all lies within the window"


def _colours(_f: Facts, options: Options) -> Answer:
    return (True, "faces are filled") if options.fill else (False, "lines are black")


_BEFORE: tuple[Effect, ...] = (
    Effect("B-rep reader", ASKED, _brep, ("brep_parts",)),
    Effect("mesh reader", ASKED, _mesh, ("mesh_parts",)),
    Effect("section", ASKED, _section, ("cut_parts",)),
    Effect("fine mesh", SCENE, _fine),
    Effect("finer mesh where parts touch", SCENE, _touching, ("touching_parts", "touching_faces")),
    Effect("meshing of curved faces", SCENE, _curved, ("curved_triangles",)),
    Effect("triangulation of planar faces", SCENE, _planar, ("planar_triangles",)),
    Effect("rescue of faces", SCENE, _rescue, ("rescued_faces", "lost_faces")),
    Effect("repair", SCENE, _repair, ("doubled_triangles",)),
    Effect("stitching of borders", SCENE, _stitching, ("seams",)),
    Effect("intersection search", SCENE, _clash, ("clash_tests",)),
    Effect("outlines", SCENE, _outlines, ("outlines",)),
    Effect("near clipping", SCENE, _near, ("near_cuts",)),
    Effect("side clipping", SCENE, _sides, ("side_cuts",)),
    Effect("perspective divide", SCENE, _divide, ("divided_points",)),
    Effect("seeing through glass", ASKED, _glass, ("glass_triangles",)),
    Effect("back-face culling", SCENE, _culling, ("culled",)),
    Effect("crossing search", SCENE, _crossings, ("seeds", "crossing_tests")),
    Effect("depth pyramid", SCENE, _pyramid, ("pyramid_parts", "hidden_by_pyramid")),
    Effect("piercing search", SCENE, _piercings, ("piercing_tests",)),
    Effect("contact tolerance", SCENE, _contact, ("contacts",)),
    _view_effect("hidden", "hidden lines", "hidden_lines", False, ": what nothing shows of goes no further"),
)

_AFTER: tuple[Effect, ...] = (
    _option_effect("circles", "circles of meshes", "circles"),
    Effect("exact curves", SCENE, _exact, ("curves_sought",)),
    Effect(LEGIBILITY, ASKED, _legibility, ("left_out",)),
    _option_effect("fill", "fill", "filled_faces"),
    Effect("window", ASKED, _window, ("window_cuts",)),
    Effect("colours", ASKED, _colours, ("coloured_faces", "gradients")),
)


@LINE_CLASSES.derived
def left_to_view() -> Mapping[str, str]:
    """Options that may be left to the kind of view, and their effects."""
    rows = {row.option: row.title for row in counted() if row.option is not None and row.by_default is None}
    return {"hidden": "hidden lines", **rows}


@LINE_CLASSES.derived
def drawing_effects() -> tuple[Effect, ...]:
    """The table; the line classes that are counted have a row each."""
    return (*_BEFORE, *map(_lines_of, counted()), *_AFTER)
