"""Run every example. With pypdfium2 installed, also make the raster pictures that the gallery page shows."""

import runpy
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

here = Path(__file__).parent
DOTS_PER_MM = 5


def raster(drawing, path):
    """The drawing as a PNG on white, grey unless it is filled, by way of its PDF."""
    import pypdfium2

    with TemporaryDirectory() as folder:
        page = pypdfium2.PdfDocument(drawing.save(Path(folder) / "page.pdf").read_bytes())[0]
        image = page.render(scale=DOTS_PER_MM * 25.4 / 72).to_pil()
        image = image.convert("L").quantize(16) if drawing.fill is None else image.convert("RGB").quantize(64)
    image.save(path, optimize=True)


def main():
    for script in sorted(here.glob("[0-9]*.py")):
        print(script.name)
        names = runpy.run_path(str(script))
        if not find_spec("pypdfium2") or "pictures" in names:  # those are raster pictures already
            continue
        name = script.stem.partition("_")[2]
        if "drawings" in names:
            for drawing in names["drawings"]:
                raster(drawing, here / f"{name}-{drawing.view.name}.png")
        else:
            raster(names["drawing"], here / f"{name}.png")


if __name__ == "__main__":
    main()
