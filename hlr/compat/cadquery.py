"""CadQuery: getSVG, exportSVG, exportDXFProjection and exporters.export with hlr's lines; and PDF."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from hlr.common.types import Floats
from hlr.compat import viewport
from hlr.compat.cadquery_dxf import exportDXFProjection
from hlr.compat.cadquery_options import check_options
from hlr.compat.cadquery_page import Page, lay_out, to_pdf, to_svg
from hlr.drawing import files
from hlr.errors import OptionError
from hlr.request.accuracy import PIXEL_ACCURACY, SMALL_DRAWING
from hlr.source.cad.objects import is_shape_like

__all__ = ["export", "exportDXFProjection", "exportSVG", "getSVG"]

WRITERS = {"SVG": to_svg, "PDF": to_pdf}


def getSVG(shape: Any, opts: Mapping[str, Any] | None = None) -> str:
    """A shape as SVG text, with CadQuery's options, size and placement.

    Args:
        shape: a CadQuery shape, a Workplane, or whatever else `hlr.draw` takes.
        opts: the keys of CadQuery: width, height (pixels; one may be None and follows from the other), marginLeft,
            marginTop, projectionDir, showAxes, strokeWidth (model units; -1: one pixel), strokeColor, hiddenColor,
            showHidden, focus, and up of its development version.

    Raises:
        HlrError: the shape or an option cannot be drawn; the message says why.
    """
    return to_svg(_page(shape, opts)).decode("utf-8")


def exportSVG(shape: Any, fileName: str, opts: Mapping[str, Any] | None = None) -> None:
    """The object on top of a Workplane's stack as an SVG file, in place of CadQuery's function of that name.

    Raises:
        HlrError: it cannot be drawn or written; the message says why.
    """
    _save(shape.val() if hasattr(shape, "val") else shape, Path(fileName), "SVG", opts)


def export(
    w: Any,
    fname: str,
    exportType: str | None = None,
    tolerance: float = 0.1,
    angularTolerance: float = 0.1,
    unit: Any = "MM",
    outputUnit: Any = None,
    opt: Mapping[str, Any] | None = None,
) -> None:
    """In place of cadquery.exporters.export: SVG and PDF are drawn by hlr, all other types are left to CadQuery.

    A drawing takes nothing from tolerance, angularTolerance, unit and outputUnit, as in CadQuery.

    Raises:
        HlrError: it cannot be drawn or written; the message says why.
    """
    kind = exportType or str(fname).rpartition(".")[2].upper()
    if kind in WRITERS:
        several = isinstance(w, Iterable) and not is_shape_like(w)
        _save(list(w) if several else w, Path(fname), kind, opt)
        return
    from cadquery import exporters

    given = {} if opt is None else dict(opt)
    exporters.export(w, fname, kind if exportType else None, tolerance, angularTolerance, unit, outputUnit, given)


def _save(shape: Any, path: Path, kind: str, opts: Mapping[str, Any] | None) -> None:
    files.check_writable(path)
    files.write_all({path: WRITERS[kind](_page(shape, opts))})


def _page(shape: Any, opts: Mapping[str, Any] | None) -> Page:
    if opts is not None and not isinstance(opts, Mapping):
        raise OptionError(f"opts needs a dictionary, not {opts!r}")
    options = check_options({} if opts is None else opts)
    view = viewport.viewport_along(options.projectionDir, "projectionDir", options.focus, options.up)

    def accuracy(bounds: Floats) -> float:
        """A share of a pixel, and less for small pictures."""
        width, height = viewport.flat_extent(bounds, view)
        finest = (width**2 + height**2) ** 0.5 / SMALL_DRAWING
        return min(PIXEL_ACCURACY / options.unit_scale(width, height), finest) if finest else 1.0

    picture = viewport.draw_viewport(shape, view, hidden=options.showHidden, accuracy=accuracy)
    return lay_out(picture, options)
