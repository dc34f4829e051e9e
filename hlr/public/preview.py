"""Shaded pictures: `hlr.preview` and `hlr.preview_views`."""

from __future__ import annotations

from typing import Any, Unpack

from hlr.common.keywords import record_of, shown
from hlr.common.types import Progress
from hlr.drawing.picture import Picture
from hlr.pipeline.preview import preview_views
from hlr.request.options import View
from hlr.request.picture_effects import PreviewOptions, PreviewWishes


@shown(PreviewOptions)
def preview(
    source: Any, view: View = "iso", *, progress: Progress | None = None, **options: Unpack[PreviewWishes]
) -> Picture:
    """A shaded picture of one view of a source; the keywords are the fields of `PreviewOptions`.

    source, view and progress are as of `hlr.draw`.

    Raises SourceError, ViewError, OptionError; with strict=True StrictError for any warning.

    >>> import hlr
    >>> picture = hlr.preview("part.step", size=(320, 240), ids=True)
    >>> picture.pixels.shape, picture.pixels.dtype
    ((240, 320, 4), dtype('uint8'))
    >>> picture.parts[picture.part_ids[120, 160]].name
    'part'
    >>> picture.save("part.png").name
    'part.png'
    """
    return preview_views(source, [view], record_of(PreviewOptions, options, "preview"), progress)[0]


__all__ = ["preview", "preview_views"]
