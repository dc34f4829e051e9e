"""Filled faces as hatches of DXF: solid areas in true colours, the large ones first.

DXF has no gradient along a line of one's own: a face that has one gets the colour in its middle. R12 has no hatches at
all; there the faces are left out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from hlr.drawing.fill import Fill
from hlr.writers.dxf_entities import PLACES
from hlr.writers.fill import faces

if TYPE_CHECKING:
    from ezdxf.layouts import Modelspace

EVEN_ODD = 0
"""Style of a hatch: loops inside others are holes."""


def hatch(model: Modelspace, fill: Fill, layer: str) -> None:
    """Add the faces to the model space."""
    from ezdxf.colors import rgb2int

    for k, loops in faces(fill, PLACES):
        *color, opacity = fill.colors[k].tolist()
        along = int(fill.gradient[k])
        if along >= 0:
            gradient = fill.gradients[along]
            color = gradient.colors[abs(gradient.shares - 0.5).argmin()].tolist()
        area = model.add_hatch(
            dxfattribs={"layer": layer, "true_color": rgb2int(tuple(color)), "hatch_style": EVEN_ODD}
        )
        if opacity < 255:
            area.transparency = 1.0 - opacity / 255.0
        for loop in loops:
            area.paths.add_polyline_path([(float(x), float(y)) for x, y in loop], is_closed=True)
