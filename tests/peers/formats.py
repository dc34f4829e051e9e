"""The same drawing in every format, opened by independent programs and compared pixel by pixel.

    python -m peers.formats FILE... -o DIR
    python -m peers.formats FILE... -o DIR --view front --page A3

SVG is opened by Chromium, PDF by poppler, PNG by Pillow, DXF by ezdxf's own renderer and by LibreCAD; a program that is
not installed is left out. LibreCAD prints as large as fits its paper, so only the shape of its ink is compared. For
every pair the table gives the share of the ink of one that has no ink of the other within a line's width. Pictures of
each, and of what differs, lie in DIR.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from itertools import permutations
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image
from scipy.ndimage import distance_transform_edt

import hlr

DPI = 192
"""Twice the pixels of CSS, which Chromium needs whole."""
WIDTH_MM = 0.5
"""How far ink may be from ink: the width of a wide line."""
DARK = 0.35
"""Share of black from which a pixel is ink; thin lines are grey."""
PATIENCE_S = 180.0

Mask = npt.NDArray[np.bool_]


def ink(path: Path) -> Mask:
    """(h, w) where a picture has ink."""
    with Image.open(path) as opened:
        rgba = opened.convert("RGBA")
    white = Image.new("RGBA", rgba.size, "white")
    grey = np.asarray(Image.alpha_composite(white, rgba).convert("L"), float)
    return np.asarray(grey < 255.0 * (1.0 - DARK))


def run(*command: str | Path) -> None:
    """Run a program that writes a file; its words appear only if it fails."""
    made = subprocess.run(command, check=False, capture_output=True, text=True, timeout=PATIENCE_S)
    if made.returncode:
        raise RuntimeError(f"{command[0]}: {made.stderr.strip()[-400:]}")


def chromium(source: Path, picture: Path, size: tuple[int, int]) -> None:
    """A screenshot of the SVG as a page shows it."""
    width, height = (-(-pixels // 2) for pixels in size)
    page = picture.with_suffix(".html")
    page.write_text(f'<body style="margin:0"><img style="display:block" src="{source.resolve().as_uri()}">')
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=2"]
    run("chromium", *flags, f"--window-size={width},{height}", f"--screenshot={picture}", page.as_uri())
    page.unlink()


def poppler(source: Path, picture: Path, _size: tuple[int, int]) -> None:
    """The PDF's only page."""
    run("pdftocairo", "-png", "-singlefile", "-r", str(DPI), source, picture.with_suffix(""))


def pillow(source: Path, picture: Path, _size: tuple[int, int]) -> None:
    """The PNG itself."""
    shutil.copy(source, picture)


def ezdxf(source: Path, picture: Path, size: tuple[int, int]) -> None:
    """The DXF by ezdxf's drawing add-on, its limits as the page."""
    import ezdxf as library
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt
    from ezdxf.addons.drawing import Frontend, RenderContext
    from ezdxf.addons.drawing.config import BackgroundPolicy, ColorPolicy, Configuration, LineweightPolicy
    from ezdxf.addons.drawing.matplotlib import MatplotlibBackend

    document = library.readfile(source)
    errors = document.audit().errors
    if errors:
        raise RuntimeError(f"{source.name}: ezdxf's audit finds {errors}")
    figure = plt.figure(figsize=(size[0] / DPI, size[1] / DPI), dpi=DPI)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    settings = Configuration(
        background_policy=BackgroundPolicy.WHITE,
        color_policy=ColorPolicy.BLACK,
        lineweight_policy=LineweightPolicy.ABSOLUTE,
    )
    backend = MatplotlibBackend(axes)
    Frontend(RenderContext(document), backend, config=settings).draw_layout(document.modelspace(), finalize=False)
    (left, bottom), (right, top) = document.header["$LIMMIN"], document.header["$LIMMAX"]
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="auto")
    axes.set_axis_off()
    figure.savefig(picture, dpi=DPI, facecolor="white")
    plt.close(figure)


def librecad(source: Path, picture: Path, size: tuple[int, int]) -> None:
    """The DXF as LibreCAD prints it, which is as large as its paper: its ink is brought to the size of the PNG's."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(shutil.copy(source, folder))
        run("env", "QT_QPA_PLATFORM=offscreen", "librecad", "dxf2pdf", "--fit", "--monochrome", copy)
        printed = Path(folder) / "printed.png"
        poppler(copy.with_suffix(".pdf"), printed, size)
        with Image.open(printed) as opened:
            drawn = opened.convert("L").crop(box(ink(printed)))
    left, top, right, bottom = box(ink(source.with_suffix(".png")))
    sheet = Image.new("L", size, 255)
    sheet.paste(drawn.resize((right - left, bottom - top), Image.Resampling.LANCZOS), (left, top))
    sheet.save(picture)


def box(mask: Mask) -> tuple[int, int, int, int]:
    """Left, top, right and bottom of the ink, pixels."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1


READERS: dict[str, tuple[str, str | None, Callable[[Path, Path, tuple[int, int]], None]]] = {
    "Pillow": ("png", None, pillow),
    "Chromium": ("svg", "chromium", chromium),
    "poppler": ("pdf", "pdftocairo", poppler),
    "ezdxf": ("dxf", None, ezdxf),
    "LibreCAD": ("dxf", "librecad", librecad),
}
"""Programs by name: the format each opens, the command it needs, and the function that makes a picture with it."""


def astray(one: Mask, other: Mask) -> tuple[float, Mask]:
    """The share of the ink of `one` without ink of `other` within a line's width, and where that is."""
    height, width = (min(a, b) for a, b in zip(one.shape, other.shape, strict=True))
    one, other = one[:height, :width], other[:height, :width]
    far = one & (distance_transform_edt(~other) > WIDTH_MM * DPI / 25.4)
    return float(far.sum()) / max(int(one.sum()), 1), far


def compare(path: Path, out: Path, view: str, page: str) -> dict[tuple[str, str], float]:
    """The shares by pair of programs; pictures go to `out`."""
    drawing = hlr.draw(str(path), view, page=page, style=hlr.Style(dpi=DPI))
    stem = f"{path.stem}-{view}"
    files = {kind: out / f"{stem}.{kind}" for kind in ("png", "svg", "pdf", "dxf")}
    for file in files.values():
        drawing.save(file)
    with Image.open(files["png"]) as opened:
        size = opened.size
    masks: dict[str, Mask] = {}
    for name, (kind, command, show) in READERS.items():
        if command is not None and shutil.which(command) is None:
            continue
        picture = out / f"{stem}-{name}.png"
        show(files[kind], picture, size)
        masks[name] = ink(picture)
    shares = {}
    for one, other in permutations(masks, 2):
        shares[one, other], far = astray(masks[one], masks[other])
        if far.any():
            Image.fromarray(~far).save(out / f"{stem}-{one}-not-{other}.png")
    return shares


def main(arguments: Sequence[str]) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--view", default="iso")
    parser.add_argument("--page", default="A4")
    asked = parser.parse_args(arguments)
    asked.out.mkdir(parents=True, exist_ok=True)
    for path in asked.files:
        for (one, other), share in compare(path, asked.out, asked.view, asked.page).items():
            print(f"{path.name:36} {one:>9} without {other:9} {100.0 * share:8.4f} %", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
