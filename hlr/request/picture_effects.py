"""The request for a preview, and the table of its effects: which of them the request and the scene call for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Integral
from typing import Any

import numpy as np

from hlr.common.numbers import typed
from hlr.errors import OptionError
from hlr.request.check import checked
from hlr.request.defaults import CREASE, PREVIEW_BACKGROUND, PREVIEW_LOOK, PREVIEW_SIZE
from hlr.request.effect import ASKED, SCENE, Effect, Facts, Planner
from hlr.request.options import Chosen, Options, Parameter, Perspective, Vector
from hlr.request.style_check import MOST_PIXELS, MOST_PIXELS_A_SIDE

PIXELS_PER_MM = 4.0
"""A picture counts as a sheet of paper with this many pixels per millimetre: lines have their ISO 128 widths on it, and
the accuracy of 0.05 mm is a fifth of a pixel."""

AMBIENT, DIFFUSE = 0.2, 0.8
"""Shares of the light, in linear light: from everywhere, and from a light beside the viewer. They add up to one."""

SHOULDER = (-0.3, 0.45, 1.0)
"""Direction toward the light: right, up, toward the viewer."""

SPECULAR = 0.35
"""Strength of highlights, as a share of full light."""

OCCLUSION = 0.045
"""Radius of ambient occlusion, as a share of the picture's smaller side."""

LEAST_TEXELS, MOST_TEXELS = 1024, 4096
"""Texels along a side of the shadow map. Between the two: one for each pixel along the picture's longer side."""

LOOKS = ("shaded", "wireframe", "depth-cued")
"""Shaded faces; all lines without faces; the same lines, paler with distance."""


@dataclass(frozen=True, slots=True)
class PreviewOptions:
    """What is asked of a shaded picture.

    look         shaded: faces; wireframe: all lines, hidden or not, and no faces; depth-cued: a wireframe whose lines
                 are the paler the farther away
    size         (width, height) in pixels
    background   a CSS colour name, #rrggbb, or transparent
    edges        the drawing's own visible lines on top
    antialias    sixteen samples a pixel instead of one
    shadows      the light casts shadows
    occlusion    corners and crevices are darker (ambient occlusion, in screen space)
    specular     highlights
    depth, ids   also make the depth map and the map of parts and faces
    smooth       with edges: also tangent edges, thin; None: in pictorial views
    crease       degrees: a mesh without B-rep is smooth where it folds less than this
    accuracy     None: 0.05 mm at 4 pixels a millimetre, a fifth of a pixel
    up, perspective, threads, strict, only, hide, var, parameters, annotations, hidden_objects   as of
                 `Options`

    >>> import hlr
    >>> options = hlr.PreviewOptions(size=(320, 240), background="transparent", shadows=True)
    >>> hlr.preview_views("part.step", ["iso"], options)
    [<Picture part.step, iso, 320x240 pixels>]
    """

    size: tuple[int, int] = PREVIEW_SIZE
    background: str = PREVIEW_BACKGROUND
    edges: bool = False
    antialias: bool = True
    shadows: bool = False
    occlusion: bool = False
    specular: bool = False
    depth: bool = False
    ids: bool = False
    smooth: bool | None = None
    crease: float = CREASE
    accuracy: float | None = None
    up: Vector | None = None
    perspective: Perspective | None = None
    threads: int = 0
    strict: bool = False
    only: tuple[str, ...] = ()
    hide: tuple[str, ...] = ()
    var: str | None = None
    parameters: Mapping[str, Parameter] | None = field(default=None, hash=False)
    annotations: bool = False
    hidden_objects: bool = False
    look: str = PREVIEW_LOOK


class PreviewWishes(Chosen, total=False):
    """The fields of `PreviewOptions` as the keywords of `hlr.preview`: none has to be given."""

    size: tuple[int, int]
    background: str
    edges: bool
    antialias: bool
    shadows: bool
    occlusion: bool
    specular: bool
    depth: bool
    ids: bool
    smooth: bool | None
    crease: float
    accuracy: float | None
    up: Vector | None
    perspective: Perspective | None
    threads: int
    strict: bool
    look: str


@dataclass(frozen=True, slots=True)
class Effects:
    """The kernel's instructions.

    faces      are shaded
    lines      are drawn
    behind     lines that only transparent parts hide are drawn too, lighter
    cued       lines are paler with distance
    antialias  sixteen samples per pixel
    shadows    texels along a side of the shadow map; 0: no shadows
    occlusion  radius of ambient occlusion in pixels; 0: none
    specular   strength of highlights; 0: none
    glass      some parts are transparent: their back faces are seen through their front faces
    """

    faces: bool
    lines: bool
    behind: bool
    cued: bool
    antialias: bool
    shadows: int
    occlusion: float
    specular: float
    glass: bool


def _option_effect(name: str, option: str) -> Effect:
    def needed(_facts: Facts, options: PreviewOptions) -> tuple[bool, str]:
        return (True, "asked for") if getattr(options, option) else (False, "not asked for")

    return Effect(name, ASKED, needed)


def _smooth(f: Facts, _o: PreviewOptions) -> tuple[bool, str]:
    if not f.faces:
        return True, "a mesh is smooth where it folds less than the crease angle"
    return f.curved > 0, f"{f.curved:,} curved faces" if f.curved else "all faces are planar"


def _glass(f: Facts, _o: PreviewOptions) -> tuple[bool, str]:
    return f.opacity < 1.0, f"the least opacity is {f.opacity:g}" if f.opacity < 1.0 else "all is opaque"


def _tied(f: Facts, _o: PreviewOptions) -> tuple[bool, str]:
    told = f"depths are told apart down to {typed(f.depth, 2, 15)} mm, a pixel is {typed(f.pixel, 2, 15)} mm"
    return f.depth > f.pixel, told


def _faces(_f: Facts, o: PreviewOptions) -> tuple[bool, str]:
    return o.look == "shaded", f"the look is {o.look}"


def _lines(_f: Facts, o: PreviewOptions) -> tuple[bool, str]:
    if o.look != "shaded":
        return True, f"the look is {o.look}: all lines, whatever lies before them"
    return (True, "asked for") if o.edges else (False, "not asked for")


def _behind(f: Facts, o: PreviewOptions) -> tuple[bool, str]:
    if not o.edges or o.look != "shaded":
        return False, "no lines that something could hide"
    return f.opacity < 1.0, "through glass they are seen, lighter" if f.opacity < 1.0 else "all is opaque"


def _cued(_f: Facts, o: PreviewOptions) -> tuple[bool, str]:
    return o.look == "depth-cued", f"the look is {o.look}"


def _eye(f: Facts, _o: PreviewOptions) -> tuple[bool, str]:
    return f.perspective, "the camera has an eye" if f.perspective else "a parallel view: nothing is magnified"


PREVIEW: tuple[Effect, ...] = (
    Effect("smooth normals", SCENE, _smooth),
    Effect("transparency", SCENE, _glass),
    Effect("perspective divide", SCENE, _eye),
    Effect("ties of depth", SCENE, _tied),
    Effect("faces", ASKED, _faces),
    Effect("lines", ASKED, _lines),
    Effect("lines behind glass", SCENE, _behind),
    Effect("depth cueing", ASKED, _cued),
    _option_effect("antialiasing", "antialias"),
    _option_effect("shadows", "shadows"),
    _option_effect("ambient occlusion", "occlusion"),
    _option_effect("specular light", "specular"),
    _option_effect("depth map", "depth"),
    _option_effect("map of faces", "ids"),
)
"""The table of a preview's effects."""


def decide_effects(
    options: PreviewOptions, opacity: float, facts: Facts | None = None, planner: Planner | None = None
) -> Effects:
    """Decide the effects of a picture. opacity: the least of a part, 0 to 1; planner: keeps the decisions."""
    planner = planner or Planner(PREVIEW, options)
    facts = (facts or Facts())._replace(opacity=opacity)
    on = {effect.name: planner.on(effect.name, facts) for effect in PREVIEW}
    return Effects(
        faces=on["faces"],
        lines=on["lines"],
        behind=on["lines behind glass"],
        cued=on["depth cueing"],
        antialias=on["antialiasing"],
        shadows=min(MOST_TEXELS, max(LEAST_TEXELS, *options.size)) if on["shadows"] else 0,
        occlusion=max(4.0, OCCLUSION * min(options.size)) if on["ambient occlusion"] else 0.0,
        specular=SPECULAR if on["specular light"] else 0.0,
        glass=on["transparency"],
    )


def checked_preview(options: PreviewOptions) -> PreviewOptions:
    """The same options, checked: types, ranges, contradictions. Raises OptionError that says what is allowed."""
    for name in ("edges", "antialias", "shadows", "occlusion", "specular", "depth", "ids"):
        value = getattr(options, name)
        if not isinstance(value, (bool, np.bool_)) and not (isinstance(value, Integral) and value in (0, 1)):
            raise OptionError(f"{name} is yes or no: give True or False, not {value!r}")
    if options.look not in LOOKS:
        raise OptionError(f"no look is called {options.look!r}: use {', '.join(LOOKS)}")
    light = [name for name in ("shadows", "occlusion", "specular") if getattr(options, name)]
    if light and options.look != "shaded":
        raise OptionError(f"a {options.look} look has no faces, so no {light[0]}: leave out one of them")
    check_size(options.size)
    if not isinstance(options.background, str):
        raise OptionError(f"background {options.background!r} is no colour: give a name, #rrggbb or transparent")
    checked(line_options(options, None))
    return options


def check_size(size: Any) -> None:
    """Raises OptionError unless the size is a width and a height in pixels that a picture can have."""
    sides = list(size) if isinstance(size, Sequence) and not isinstance(size, str) else []
    if len(sides) != 2 or not all(isinstance(s, Integral) and not isinstance(s, bool) for s in sides):
        raise OptionError(f"size needs a width and a height in whole pixels, such as 1920x1080, not {size!r}")
    width, height = sides
    if min(sides) < 1 or max(sides) > MOST_PIXELS_A_SIDE or width * height > MOST_PIXELS:
        raise OptionError(
            f"a picture of {width}x{height} pixels cannot be made: give 1 to {MOST_PIXELS_A_SIDE} a side, "
            f"and {MOST_PIXELS // 1_000_000} million at most"
        )


def line_options(options: PreviewOptions, fit: tuple[float, float] | None, scale: float | None = None) -> Options:
    """The request for a picture's line drawing, with the same camera. fit: (width, height), millimetres on paper."""
    return Options(
        hidden=options.look != "shaded",
        smooth=options.smooth,
        scale=scale,
        fit=fit,
        accuracy=options.accuracy,
        crease=options.crease,
        up=options.up,
        perspective=options.perspective,
        threads=options.threads,
        strict=options.strict,
        only=options.only,
        hide=options.hide,
        var=options.var,
        parameters=options.parameters,
        annotations=options.annotations,
        hidden_objects=options.hidden_objects,
        details=True,
    )
