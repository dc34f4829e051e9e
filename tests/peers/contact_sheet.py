"""The drawings of many models on one sheet, to be looked at: what a user gets who asks for nothing.

    python -m peers.contact_sheet FILE... -o SHEET.png
    python -m peers.contact_sheet FILE... -o SHEET.png --view front --columns 6

Each drawing is made by the command `hlr draw` in a process of its own, as PDF, and shown as its whole page with its
name, scale, seconds and the notes that came with it. What cannot be drawn shows its error.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import pypdfium2
from PIL import Image, ImageDraw, ImageFont

CELL = (640, 520)
"""Pixels of a drawing on the sheet."""
TEXT = 64
"""Pixels of height for the words below it."""
PATIENCE_S = 200.0


@dataclass(frozen=True)
class Shown:
    """One drawing: its page as a picture, None where there is none, and the words below it."""

    picture: Image.Image | None
    words: str


def drawn(path: Path, view: str, more: Sequence[str]) -> Shown:
    """The default drawing of a file."""
    with TemporaryDirectory() as folder:
        out = Path(folder) / "drawing.pdf"
        command = [sys.executable, "-P", "-m", "hlr", "draw", str(path), "--view", view, "-o", str(out), *more]
        started = perf_counter()
        try:
            made = subprocess.run(command, check=False, capture_output=True, text=True, timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            return Shown(None, f"{path.name}: not drawn in {PATIENCE_S:g} s")
        words = f"{path.name} {perf_counter() - started:.1f} s {' '.join(made.stderr.split())}"
        if made.returncode or not out.exists():
            return Shown(None, words)
        page = pypdfium2.PdfDocument(out)[0]
        scale = min(CELL[0] / page.get_width(), CELL[1] / page.get_height())
        return Shown(page.render(scale=scale).to_pil().convert("RGB"), words)


def sheet(shown: Sequence[Shown], columns: int) -> Image.Image:
    """All drawings in rows."""
    width, height = CELL[0] + 8, CELL[1] + TEXT
    rows = -(-len(shown) // columns)
    out = Image.new("RGB", (columns * width, rows * height), "lightgrey")
    draw, font = ImageDraw.Draw(out), ImageFont.load_default(12)
    for i, one in enumerate(shown):
        x, y = (i % columns) * width, (i // columns) * height
        if one.picture is not None:
            out.paste(one.picture, (x + (CELL[0] - one.picture.width) // 2, y))
        draw.multiline_text((x + 4, y + CELL[1] + 2), "\n".join(textwrap.wrap(one.words, 100)[:4]), "black", font)
    return out


def main(arguments: Sequence[str]) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--view", default="iso")
    parser.add_argument("--columns", type=int, default=4)
    asked, more = parser.parse_known_args(arguments)
    shown = []
    for path in asked.files:
        shown.append(drawn(path, asked.view, more))
        print(shown[-1].words, flush=True)
    sheet(shown, asked.columns).save(asked.out)


if __name__ == "__main__":
    main(sys.argv[1:])
