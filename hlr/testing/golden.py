"""`assert_same_drawing`: a drawing beside its golden one."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from hlr.request.defaults import COMPARE_TOLERANCE_MM
from hlr.testing.session import SESSION

if TYPE_CHECKING:
    from hlr.compare import Comparison
    from hlr.compare.compare import Registration
    from hlr.drawing.drawing import Drawing
    from hlr.request.options import View, Wishes

ENDINGS = (".svg", ".json")

UPDATE = "--hlr-update"
"""The flag of pytest that writes golden drawings anew."""

_MOST_ROWS = 10


def assert_same_drawing(
    part: Any,
    golden: str | os.PathLike[str],
    *,
    view: View | None = None,
    tolerance_mm: float = COMPARE_TOLERANCE_MM,
    register: Registration = "translation",
    **wishes: Unpack[Wishes],
) -> None:
    """Fail where a drawing differs from the golden one by more than the tolerance.

    part          a `Drawing`, or what `hlr.draw` draws: a shape, an assembly, a mesh, the path of a model
    golden        path of an SVG or JSON file of hlr; a relative one starts from the folder of the test
    view          of a part: as of `hlr.draw`; None: isometric
    tolerance_mm  how far apart on paper two lines may lie that count as the same
    register      "off": from the lower left corner of the drawing, which moves where a part grows to the left
    wishes        of a part: fields of `Options`; with a `scale` a change of size does not change all lines

    Raises AssertionError, which says what differs and where the overlay is. With `pytest --hlr-update` a golden drawing
    that is missing or differs is written instead. Raises OptionError for a path with another ending, and for a view or
    wishes beside a `Drawing`; else what `hlr.draw` raises.
    """
    __tracebackhide__ = True
    drawing = _drawing(part, view, wishes)
    path = _path(golden)
    if not path.exists():
        if not SESSION.update:
            raise AssertionError(f"{path} is not there: pytest {UPDATE} writes it")
        _save(drawing, path)
        return
    from hlr.compare import compare

    found = compare(path, drawing, tolerance_mm=tolerance_mm, register=register)
    if found.same:
        return
    if SESSION.update:
        _save(drawing, path)
        return
    raise AssertionError(_told(found, drawing, path))


def _drawing(part: Any, view: View | None, wishes: Wishes) -> Drawing:
    from hlr.drawing.drawing import Drawing
    from hlr.errors import OptionError

    if isinstance(part, Drawing):
        if view is not None or wishes:
            raise OptionError("a drawing has its view and options already: give them with a part")
        return part
    from hlr.public.draw import draw

    return draw(part, "iso" if view is None else view, **wishes)


def _path(golden: str | os.PathLike[str]) -> Path:
    from hlr.errors import OptionError

    path = Path(golden)
    if path.suffix.lower() not in ENDINGS:
        raise OptionError(f"{path} cannot be a golden drawing: its name has to end in {' or '.join(ENDINGS)}")
    return (SESSION.beside or Path.cwd()) / path


def _save(drawing: Drawing, path: Path) -> None:
    from hlr.drawing.files import write_all
    from hlr.drawing.saving import render

    write_all({path: render(drawing, "svg" if path.suffix.lower() == ".svg" else "json")}, [path.parent])


def _told(found: Comparison, drawing: Drawing, path: Path) -> str:
    """What a failure says. The overlay and the drawing are kept for whoever looks."""
    from hlr.compare.overlay.table import rows

    folder = SESSION.temporary() if SESSION.temporary else Path(tempfile.mkdtemp(prefix="hlr-"))
    overlays = [found.save(folder / f"{path.stem}-overlay{ending}") for ending in (".svg", ".png")]
    drawn = folder / path.name
    _save(drawing, drawn)
    return "\n".join(
        [
            f"{drawing.source}, {drawing.view.name}, differs from {path}: {found.summary}",
            *rows(found, _MOST_ROWS),
            f"overlay: {' and '.join(map(str, overlays))}",
            f"drawing: {drawn}",
            f"If the drawing is right: pytest {UPDATE} writes it to {path.name}",
        ]
    )
