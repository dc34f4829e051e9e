"""Hidden-line drawings of CAD models: exact visible and hidden edges.

>>> import hlr
>>> hlr.draw("part.step", view="iso").save("part.svg")

Names are loaded when first used: `import hlr` costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hlr import compat, study, surfaces
    from hlr.comparison import compare_methods as methods
    from hlr.curve import Arc, Bezier
    from hlr.drawing import Accuracy, Bounds, Drawing, Kind, Line
    from hlr.drawings import draw, draw_views
    from hlr.errors import HlrError, OptionError, SourceError, StrictError, ViewError, WriteError
    from hlr.inspection import info
    from hlr.loading import load
    from hlr.notes import Note, NoteCode
    from hlr.picture import Picture
    from hlr.plan.effect import Decision
    from hlr.plan.effects import PreviewOptions, PreviewWishes
    from hlr.plan.options import Options, Perspective, View, ViewName, Wishes
    from hlr.planning import ViewPlan, plan_views
    from hlr.previews import preview, preview_views
    from hlr.scene.report import ModelInfo, PartReport
    from hlr.writers import Format

__version__ = "0.1.0"

_HOME = {
    "Accuracy": "hlr.drawing",
    "Arc": "hlr.curve",
    "Bezier": "hlr.curve",
    "Bounds": "hlr.drawing",
    "Decision": "hlr.plan.effect",
    "Drawing": "hlr.drawing",
    "Format": "hlr.writers",
    "HlrError": "hlr.errors",
    "Kind": "hlr.drawing",
    "Line": "hlr.drawing",
    "ModelInfo": "hlr.scene.report",
    "Note": "hlr.notes",
    "NoteCode": "hlr.notes",
    "OptionError": "hlr.errors",
    "Options": "hlr.plan.options",
    "PartReport": "hlr.scene.report",
    "Perspective": "hlr.plan.options",
    "Picture": "hlr.picture",
    "PreviewOptions": "hlr.plan.effects",
    "PreviewWishes": "hlr.plan.effects",
    "SourceError": "hlr.errors",
    "StrictError": "hlr.errors",
    "View": "hlr.plan.options",
    "ViewError": "hlr.errors",
    "ViewName": "hlr.plan.options",
    "ViewPlan": "hlr.planning",
    "Wishes": "hlr.plan.options",
    "WriteError": "hlr.errors",
    "draw": "hlr.drawings",
    "draw_views": "hlr.drawings",
    "info": "hlr.inspection",
    "load": "hlr.loading",
    "methods": "hlr.comparison",
    "plan_views": "hlr.planning",
    "preview": "hlr.previews",
    "preview_views": "hlr.previews",
}
"""Where each name is defined."""

_CALLED = {"methods": "compare_methods"}
"""Names that are others at home."""

_MODULES = ("compat", "study", "surfaces")

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
    "ModelInfo",
    "Note",
    "NoteCode",
    "OptionError",
    "Options",
    "PartReport",
    "Perspective",
    "Picture",
    "PreviewOptions",
    "PreviewWishes",
    "SourceError",
    "StrictError",
    "View",
    "ViewError",
    "ViewName",
    "ViewPlan",
    "Wishes",
    "WriteError",
    "compat",
    "draw",
    "draw_views",
    "info",
    "load",
    "methods",
    "plan_views",
    "preview",
    "preview_views",
    "study",
    "surfaces",
]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


if not TYPE_CHECKING:  # else a type checker would take any name for one of ours

    def __getattr__(name: str) -> object:
        from importlib import import_module

        if name in _HOME:
            return getattr(import_module(_HOME[name]), _CALLED.get(name, name))
        if name in _MODULES:
            return import_module(f"hlr.{name}")
        raise AttributeError(f"module 'hlr' has no attribute {name!r}")
