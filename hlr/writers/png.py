"""PNG by Pillow: the picture, its depth map and its map of faces, each with a description in its text chunks.

The same picture gives the same bytes: no dates, no paths.
"""

from __future__ import annotations

import io
import json
from typing import Any

import numpy as np

from hlr.drawing.picture import Picture
from hlr.errors import WriteError
from hlr.request.picture_effects import PIXELS_PER_MM

NOTHING = 65535
"""In a depth map: nothing is seen there."""

FARTHEST = 65534

MM_PER_INCH = 25.4


def picture_png(picture: Picture) -> bytes:
    """RGB, or RGBA where some of it is transparent."""
    pixels = picture.pixels
    opaque = bool((pixels[:, :, 3] == 255).all())
    return _encoded(picture, np.ascontiguousarray(pixels[:, :, :3]) if opaque else pixels, {})


def depth_png(picture: Picture) -> bytes:
    """16-bit grey: 0 nearest, 65534 farthest, 65535 nothing; Depth-Near and Depth-Far are in millimetres."""
    depth = picture.depth
    if depth is None:
        raise WriteError("the picture has no depth map: ask for it with depth=True")
    seen = np.isfinite(depth)
    near, far = (float(depth[seen].min()), float(depth[seen].max())) if seen.any() else (0.0, 0.0)
    share = (np.where(seen, depth, near) - near) / ((far - near) or 1.0)
    levels = np.where(seen, np.rint(share * FARTHEST), NOTHING).astype(np.uint16)
    return _encoded(picture, levels, {"Depth-Near": f"{near:.9g} mm", "Depth-Far": f"{far:.9g} mm"})


def ids_png(picture: Picture) -> bytes:
    """RGB: red * 65536 + green * 256 + blue is the number of the face plus one, 0 where there is none.

    The text chunk Faces is JSON: for each part its name and the number of its first face.
    """
    ids = picture.ids
    if ids is None:
        raise WriteError("the picture has no map of faces: ask for it with ids=True")
    if int(picture.first_face[-1]) >= 1 << 24:
        raise WriteError("the model has more than 16.7 million faces: they cannot be told apart in a PNG")
    number = (ids + 1).astype(np.uint32)
    rgb = np.stack([number >> 16, number >> 8, number], axis=2).astype(np.uint8)
    faces = [[part.name, int(first)] for part, first in zip(picture.parts, picture.first_face[:-1], strict=True)]
    return _encoded(picture, rgb, {"Faces": json.dumps(faces)})


def _encoded(picture: Picture, pixels: Any, more: dict[str, str]) -> bytes:
    view = picture.view
    told = {
        "Source": picture.source,
        "View": view.name,
        "Projection": view.projection,
        "Direction": ",".join(f"{c:.6g}" for c in view.direction),
        "Scale": f"{picture.scale:.9g} pixels per millimetre",
        **more,
    }
    if view.eye is not None and view.fov is not None:
        told["Eye"] = ",".join(f"{c:.9g}" for c in view.eye)
        told["Field of view"] = f"{view.fov:.6g} degrees"
    return encoded(_pillow("Image").fromarray(pixels), told, PIXELS_PER_MM * MM_PER_INCH)


def encoded(image: Any, told: dict[str, str], dpi: float | None = None) -> bytes:
    """An image of Pillow as PNG. told: its text chunks; dpi: pixels per inch."""
    from importlib.metadata import version

    info = _pillow("PngImagePlugin").PngInfo()
    for key, text in {"Software": f"hlr {version('hlr-drawing')}", **told}.items():
        # The name of a file need not be UTF-8.
        value = text.encode("utf-8", "replace").decode("utf-8")
        if value.isascii():
            info.add_text(key, value, zip=len(value) > 1000)
        else:
            info.add_itxt(key, value, zip=len(value) > 1000)
    out = io.BytesIO()
    image.save(out, "PNG", pnginfo=info, **({} if dpi is None else {"dpi": (dpi, dpi)}))
    return out.getvalue()


def _pillow(name: str) -> Any:
    from importlib import import_module

    try:
        return import_module(f"PIL.{name}")
    except ImportError:
        raise WriteError("pictures need Pillow: pip install pillow") from None
