"""Hidden-line drawings of CAD models: exact visible and hidden edges.

>>> import hlr
>>> hlr.draw("part.step", view="iso").save("part.svg")

Names are loaded when first used: `import hlr` costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hlr import compare, compat, testing
    from hlr.drawing.curve import Arc, Bezier
    from hlr.drawing.drawing import Accuracy, Drawing
    from hlr.drawing.line import Bounds, Line
    from hlr.drawing.model_info import ModelInfo, PartReport
    from hlr.drawing.notes import Note, NoteCode
    from hlr.drawing.page import Page
    from hlr.drawing.picture import Picture
    from hlr.drawing.saving import Format
    from hlr.drawing.section import Section
    from hlr.errors import HlrError, OptionError, SourceError, StrictError, ViewError, WriteError
    from hlr.lab import methods as surfaces
    from hlr.lab import study
    from hlr.lab.methods.comparison import compare_methods as methods
    from hlr.public.arranged import draw_arranged
    from hlr.public.draw import draw, draw_views
    from hlr.public.info import info
    from hlr.public.pages import draw_pages
    from hlr.public.plan import ViewPlan, plan_views
    from hlr.public.preview import preview, preview_views
    from hlr.request.effect import Decision
    from hlr.request.options import Options, Perspective, View, ViewName, Wishes
    from hlr.request.picture_effects import PreviewOptions, PreviewWishes
    from hlr.request.style import LineRule, Style
    from hlr.tables.line_classes import Kind
    from hlr.writers.loading import load

__version__ = "0.1.0"

_HOME = {
    "Accuracy": "hlr.drawing.drawing",
    "Arc": "hlr.drawing.curve",
    "Bezier": "hlr.drawing.curve",
    "Bounds": "hlr.drawing.line",
    "Decision": "hlr.request.effect",
    "Drawing": "hlr.drawing.drawing",
    "Format": "hlr.drawing.saving",
    "HlrError": "hlr.errors",
    "Kind": "hlr.tables.line_classes",
    "Line": "hlr.drawing.line",
    "LineRule": "hlr.request.style",
    "ModelInfo": "hlr.drawing.model_info",
    "Note": "hlr.drawing.notes",
    "NoteCode": "hlr.drawing.notes",
    "OptionError": "hlr.errors",
    "Options": "hlr.request.options",
    "Page": "hlr.drawing.page",
    "PartReport": "hlr.drawing.model_info",
    "Perspective": "hlr.request.options",
    "Picture": "hlr.drawing.picture",
    "PreviewOptions": "hlr.request.picture_effects",
    "PreviewWishes": "hlr.request.picture_effects",
    "Section": "hlr.drawing.section",
    "SourceError": "hlr.errors",
    "StrictError": "hlr.errors",
    "Style": "hlr.request.style",
    "View": "hlr.request.options",
    "ViewError": "hlr.errors",
    "ViewName": "hlr.request.options",
    "ViewPlan": "hlr.public.plan",
    "Wishes": "hlr.request.options",
    "WriteError": "hlr.errors",
    "draw": "hlr.public.draw",
    "draw_arranged": "hlr.public.arranged",
    "draw_pages": "hlr.public.pages",
    "draw_views": "hlr.public.draw",
    "info": "hlr.public.info",
    "load": "hlr.writers.loading",
    "methods": "hlr.lab.methods.comparison",
    "plan_views": "hlr.public.plan",
    "preview": "hlr.public.preview",
    "preview_views": "hlr.public.preview",
}
"""Where each name is defined."""

_CALLED = {"methods": "compare_methods"}
"""Names that are others at home."""

_MODULES = {
    "compare": "hlr.compare",
    "compat": "hlr.compat",
    "study": "hlr.lab.study",
    "surfaces": "hlr.lab.methods",
    "testing": "hlr.testing",
}

__all__ = [
    "Accuracy",
    "Arc",
    "Bezier",
    "Bounds",
    "Decision",
    "Drawing",
    "Format",
    "HlrError",
    "Kind",
    "Line",
    "LineRule",
    "ModelInfo",
    "Note",
    "NoteCode",
    "OptionError",
    "Options",
    "Page",
    "PartReport",
    "Perspective",
    "Picture",
    "PreviewOptions",
    "PreviewWishes",
    "Section",
    "SourceError",
    "StrictError",
    "Style",
    "View",
    "ViewError",
    "ViewName",
    "ViewPlan",
    "Wishes",
    "WriteError",
    "compare",
    "compat",
    "draw",
    "draw_arranged",
    "draw_pages",
    "draw_views",
    "info",
    "load",
    "methods",
    "plan_views",
    "preview",
    "preview_views",
    "study",
    "surfaces",
    "testing",
]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


if not TYPE_CHECKING:  # else a type checker would take any name for one of ours

    def __getattr__(name: str) -> object:
        from importlib import import_module

        if name in _HOME:
            found = getattr(import_module(_HOME[name]), _CALLED.get(name, name))
        elif name in _MODULES:
            found = import_module(_MODULES[name])
        else:
            raise AttributeError(f"module 'hlr' has no attribute {name!r}")
        globals()[name] = found  # from now on it is found without asking here
        return found
