"""Hidden-line drawings of CAD models: exact visible and hidden edges.

>>> import hlr
>>> hlr.draw("part.step", view="iso").save("part.svg")

Names are loaded when first used: `import hlr` costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hlr.drawing import Drawing, Line
    from hlr.drawings import draw, draw_views
    from hlr.errors import HlrError, OptionError, SourceError, StrictError, ViewError, WriteError
    from hlr.inspection import info
    from hlr.notes import Note
    from hlr.picture import Picture
    from hlr.plan.effect import Decision
    from hlr.plan.effects import PreviewOptions
    from hlr.plan.options import Options, Perspective
    from hlr.planning import ViewPlan, plan_views
    from hlr.previews import preview, preview_views
    from hlr.scene.report import ModelInfo, PartReport

__version__ = "0.1.0"

_HOME = {
    "Decision": "hlr.plan.effect",
    "Drawing": "hlr.drawing",
    "HlrError": "hlr.errors",
    "Line": "hlr.drawing",
    "ModelInfo": "hlr.scene.report",
    "Note": "hlr.notes",
    "OptionError": "hlr.errors",
    "Options": "hlr.plan.options",
    "PartReport": "hlr.scene.report",
    "Perspective": "hlr.plan.options",
    "Picture": "hlr.picture",
    "PreviewOptions": "hlr.plan.effects",
    "SourceError": "hlr.errors",
    "StrictError": "hlr.errors",
    "ViewError": "hlr.errors",
    "ViewPlan": "hlr.planning",
    "WriteError": "hlr.errors",
    "draw": "hlr.drawings",
    "draw_views": "hlr.drawings",
    "info": "hlr.inspection",
    "plan_views": "hlr.planning",
    "preview": "hlr.previews",
    "preview_views": "hlr.previews",
}

__all__ = [
    "Decision",
    "Drawing",
    "HlrError",
    "Line",
    "ModelInfo",
    "Note",
    "OptionError",
    "Options",
    "PartReport",
    "Perspective",
    "Picture",
    "PreviewOptions",
    "SourceError",
    "StrictError",
    "ViewError",
    "ViewPlan",
    "WriteError",
    "draw",
    "draw_views",
    "info",
    "plan_views",
    "preview",
    "preview_views",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        from importlib import import_module

        return getattr(import_module(_HOME[name]), name)
    if name == "surfaces":
        from importlib import import_module

        return import_module("hlr.surfaces")
    raise AttributeError(f"module 'hlr' has no attribute '{name}'")
