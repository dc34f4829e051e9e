"""Colours at the corners of triangles, in linear light."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints, Rgba
from hlr.scene.scene import Geometry
from hlr.source.model import DEFAULT_COLOR, Appearance

Colours = npt.NDArray[np.float32]


def corner_colors(scene: Geometry, looks: Mapping[str, Appearance]) -> tuple[Colours, Ints]:
    """Colours (k, 4), linear RGB and opacity, and (t, 3) the index of the colour at each corner."""
    table: dict[Rgba, int] = {}
    painted: list[npt.NDArray[np.float32]] = []
    paint = np.zeros((len(scene.triangles), 3), np.int32)
    # Triangles are sorted by part.
    bounds = np.searchsorted(scene.triangle_part, np.arange(len(scene.parts) + 1)).tolist()
    for i, part in enumerate(scene.parts.labels):
        a, b = bounds[i : i + 2]
        look = looks.get(part.name, Appearance())
        whole = look.whole or ((*part.color, 1.0) if part.color is not None else DEFAULT_COLOR)
        paint[a:b] = table.setdefault(whole, len(table))
        for face, color in look.faces.items():
            paint[a:b][scene.triangle_face[a:b] == face] = table.setdefault(color, len(table))
        if look.corners is not None and look.points is not None and look.triangles is not None:
            # Negative indices, until the number of colours of whole parts and faces is known.
            first = sum(map(len, painted))
            corners = scene.triangles[a:b].copy()
            turned = scene.turned[a:b]
            corners[turned] = corners[turned][:, [0, 2, 1]]
            origin = scene.triangle_origin[a:b]
            own = _interpolated(
                scene.points[corners], look.points[look.triangles[origin]], _linear(look.corners[origin])
            )
            own[turned] = own[turned][:, [0, 2, 1]]
            painted.append(own.reshape(-1, 4))
            paint[a:b] = -1 - first - np.arange(3 * (b - a), dtype=np.int32).reshape(-1, 3)
    plain = np.array(list(table), np.float32).reshape(-1, 4)
    paint = np.where(paint < 0, len(plain) - 1 - paint, paint).astype(np.int32)
    return np.concatenate([_linear(plain), *painted]), np.ascontiguousarray(paint)


def _interpolated(now: Floats, before: Floats, colours: Colours) -> Colours:
    """(m, 3, 4) colours at corners `now` (m, 3, 3) of triangles that are pieces of triangles `before` (m, 3, 3)."""
    out = colours.copy()
    cut = ~(now == before).all(axis=(1, 2))
    share = barycentric_weights(now[cut], before[cut])
    out[cut] = (share[..., None] * colours[cut][:, None]).sum(axis=2)
    return out


def _linear(srgb: Colours) -> Colours:
    """sRGB to linear RGB; opacity stays."""
    out = srgb.copy()
    c = np.clip(srgb[..., :3], 0.0, 1.0)
    out[..., :3] = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    return np.ascontiguousarray(out)


def barycentric_weights(corners: Floats, triangles: Floats) -> Floats:
    """(m, 3, 3) barycentric coordinates of points `corners` (m, 3, 3) on, or near, `triangles` (m, 3, 3)."""
    a = triangles[:, None, 0]
    u, v, w = triangles[:, None, 1] - a, triangles[:, None, 2] - a, corners - a
    uu, uv, vv = (u * u).sum(-1), (u * v).sum(-1), (v * v).sum(-1)
    wu, wv = (w * u).sum(-1), (w * v).sum(-1)
    area = uu * vv - uv * uv
    flat = area <= 0.0
    area = np.where(flat, 1.0, area)
    second = np.where(flat, 0.0, (vv * wu - uv * wv) / area)
    third = np.where(flat, 0.0, (uu * wv - uv * wu) / area)
    shares: npt.NDArray[np.float64] = np.stack([1.0 - second - third, second, third], axis=-1).clip(0.0, 1.0)
    return np.asarray(shares / shares.sum(axis=-1, keepdims=True))
