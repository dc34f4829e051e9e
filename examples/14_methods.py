"""The visible-surface methods at work: Warnock's areas as a trace, and curved patches among polygons."""

from pathlib import Path

import numpy as np
from matplotlib.image import imsave

from hlr.lab.methods import SCREEN, Patch, areas_table, render, trace_svg

here = Path(__file__).parent


def box(x0, y0, x1, y1, z):
    return [(x, y, z(x, y)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]


# Warnock: a triangle through a sloping rectangle, a smaller rectangle hidden by another, a background below.
scene = [
    box(-1, 8, 17, 17, lambda x, y: 60.0),
    box(0, 0, 8, 8, lambda x, y: 10.0),
    box(2, 2, 6, 6, lambda x, y: 30.0),
    [(9, 1.5, 40), (15, 4.5, 10), (10.5, 7, 20)],
    box(3, 10, 14, 15, lambda x, y: 30 + 2 * (x - 8.5)),
    [(5, 9, 30), (15, 11, 30), (6.5, 15.5, 30)],
]
size = (16, 16)
found = render(scene, SCREEN, size, "warnock", trace=True)
(here / "methods-warnock.svg").write_text(trace_svg(scene, SCREEN, size, "warnock"), encoding="utf-8")
counted = found.statistics
(here / "methods").mkdir(exist_ok=True)
(here / "methods" / "warnock.md").write_text(
    f"**Warnock's areas, 16 x 16 pixels** ([picture](../methods-warnock.svg)): {counted.recursion} areas. In "
    f"{counted.early_stops} of them the sorted list is not read to its end, which passes over {counted.passed_over} "
    "polygons. Endings: (a) nothing, (b) one polygon, (c) one that surrounds, (d) such a one before all others.\n\n"
    + areas_table(found.areas),
    encoding="utf-8",
)

# Patches: a paraboloid through a slanted plane, a saddle through a level one, a wave of 84 pieces before both.
size = (360, 240)
cup = Patch(((20.0, 0.0, 1 / 60), (0.0,), (1 / 60,)), (20, 20, 180, 180), origin=(100, 100))
saddle = Patch(((70.0,), (0.0, 1 / 60)), (190, 20, 350, 180), origin=(270, 100))
wave = Patch.of(lambda x, y: 30 + 9 * np.sin(x / 12) * np.cos(y / 9), (40, 150, 320, 230), across=14, down=6)
planes = [
    box(0, 0, 190, 240, lambda x, y: 70 + (x - 100) / 4 - (y - 100) / 6),
    box(190, 0, 360, 240, lambda x, y: 70.0),
]
patches = [*planes, cup, saddle, *wave]
seen = render(patches, SCREEN, size, "scan line")
assert (seen.ids == render(patches, SCREEN, size, "z-buffer").ids).all()


def shaded(picture):
    """Light from the upper left by the slopes of depth, colours by number."""
    colours = np.array([(205, 198, 185), (185, 198, 205), (222, 150, 90), (110, 160, 210), (140, 190, 120)])
    down, right = np.gradient(picture.depth)
    normal = np.stack([right, down, np.full_like(right, -1.0)], axis=2)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    light = np.clip(normal @ (np.array([-0.4, -0.5, -0.77])), 0.15, 1.0)
    # At the border between two surfaces there is no slope.
    edge = np.zeros(picture.ids.shape, bool)
    kind = np.minimum(picture.ids, 4)
    edge[:, 1:] |= kind[:, 1:] != kind[:, :-1]
    edge[1:] |= kind[1:] != kind[:-1]
    light[edge] = 0.35
    return (colours[kind] * light[:, :, None]).astype(np.uint8)


large = np.repeat(np.repeat(shaded(seen), 2, axis=0), 2, axis=1)
pictures = {"patches": large}
imsave(here / "methods-patches.png", large)
