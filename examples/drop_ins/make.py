"""Draw five models by their neighbours' own functions and by the drop-ins, side by side.

Writes one PNG per model beside this file and prints the table of README.md. It needs build123d, resvg_py and Pillow.
"""

import io
import re
import runpy
import time
from pathlib import Path

import build123d as bd
import cadquery as cq
import resvg_py
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepLib import BRepLib
from OCP.GCPnts import GCPnts_QuasiUniformDeflection
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
from OCP.HLRAlgo import HLRAlgo_Projector
from OCP.HLRBRep import HLRBRep_Algo, HLRBRep_HLRToShape
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from PIL import Image, ImageDraw

from hlr.compat.build123d import project_to_viewport
from hlr.compat.cadquery import getSVG
from hlr.compat.freecad import project_ex

HERE = Path(__file__).parent
MODELS = HERE.parent / "models"
WIDTH, CAPTION = 620, 26
KINDS = ("V", "Rg1LineV", "RgNLineV", "OutLineV", "IsoLineV", "H", "Rg1LineH", "RgNLineH", "OutLineH", "IsoLineH")


def by_cadquery(shape, options):
    from cadquery.occ_impl.exporters.svg import getSVG as getSVG_of_cadquery

    return [lambda: getSVG_of_cadquery(shape, options), lambda: getSVG(shape, options)]


def by_build123d(shape, origin, **how):
    def exported(edges):
        svg = bd.ExportSVG(scale=4, margin=1, line_weight=0.35)
        svg.add_layer("hidden", line_color=bd.Color(0.6, 0.6, 0.6), line_weight=0.2, line_type=bd.LineType.ISO_DASH)
        for layer, found in zip(("", "hidden"), edges, strict=True):
            svg.add_shape(found, layer=layer)
        file = io.BytesIO()
        svg.write(file)
        return file.getvalue().decode("utf-8")

    return [
        lambda: exported(shape.project_to_viewport(origin, **how)),
        lambda: exported(project_to_viewport(shape, origin, **how)),
    ]


def by_freecad(shape, direction):
    """FreeCAD's projectEx is this sequence of calls."""

    def original():
        algorithm = HLRBRep_Algo()
        algorithm.Add(shape)
        algorithm.Projector(HLRAlgo_Projector(gp_Ax2(gp_Pnt(), gp_Dir(*direction))))
        algorithm.Update()
        algorithm.Hide()
        found = HLRBRep_HLRToShape(algorithm)
        compounds = [getattr(found, f"{name}Compound")() for name in KINDS]
        for compound in compounds:
            if not compound.IsNull():
                BRepLib.BuildCurves3d_s(compound, 1e-3)
        return svg_of(compounds)

    return [original, lambda: svg_of(project_ex(shape, direction))]


def svg_of(compounds):
    """Sharp lines and outlines in black, tangent edges and seams thin, hidden lines grey."""
    paths, everything = [], []
    for i, compound in enumerate(compounds):
        if compound.IsNull():
            continue
        explorer = TopExp_Explorer(compound, TopAbs_ShapeEnum.TopAbs_EDGE)
        while explorer.More():
            curve = BRepAdaptor_Curve(TopoDS.Edge_s(explorer.Current()))
            found = GCPnts_QuasiUniformDeflection(curve, 0.01)
            points = [found.Value(k + 1) for k in range(found.NbPoints())]
            text = " ".join(f"{p.X():.3f},{-p.Y():.3f}" for p in points)
            everything += [(p.X(), -p.Y()) for p in points]
            grey, width = ("#999" if i >= 5 else "#000"), (0.35 if i % 5 in (0, 3) else 0.15)
            paths.append(f'<polyline points="{text}" stroke="{grey}" stroke-width="{width}"/>')
            explorer.Next()
    x0, y0 = (min(p[k] for p in everything) - 1 for k in (0, 1))
    x1, y1 = (max(p[k] for p in everything) + 1 for k in (0, 1))
    head = f'<svg xmlns="http://www.w3.org/2000/svg" fill="none" viewBox="{x0} {y0} {x1 - x0} {y1 - y0}">'
    return "\n".join((head, *reversed(paths), "</svg>"))


def step(name):
    return cq.importers.importStep(str(MODELS / name)).val()


def solids():
    """A torus with a ball in its hole and a rod through both."""
    ball = cq.Workplane().sphere(9)
    torus = cq.Workplane(cq.Solid.makeTorus(16, 6))
    return ball.union(torus).cut(cq.Workplane().cylinder(40, 3)).val().wrapped


def pictures():
    housing = runpy.run_path(str(HERE.parent / "part.py"))["result"].val()
    eye = bd.Pos(-50, 0, 0) * bd.Cylinder(26, 40)
    link = bd.fillet((eye + bd.Box(110, 24, 24)).edges().filter_by(bd.Axis.Z), 8)
    link -= bd.Pos(-50, 0, 0) * bd.Cylinder(15, 40) + bd.Pos(30, 0, 0) * bd.Rot(90, 0, 0) * bd.Cylinder(6, 40)
    look = {"width": WIDTH, "height": None, "marginLeft": 10, "marginTop": 10, "projectionDir": (1, -1, 1)}
    look |= {"hiddenColor": (140, 140, 140)}
    yield "housing", "CadQuery, getSVG", by_cadquery(housing, look)
    yield "assembly", "CadQuery, getSVG", by_cadquery(step("as1-oc-214.stp"), look)
    yield "screw", "CadQuery, getSVG", by_cadquery(step("M6-1x12-countersunk-screw.step"), look | {"showHidden": False})
    yield "link", "build123d, project_to_viewport", by_build123d(link, (200, -300, 220), focus=250)
    yield "ball", "FreeCAD, projectEx", by_freecad(solids(), (1, -2, 1.5))


def raster(svg):
    # The renderer knows no millimetres.
    svg = re.sub(r' (width|height)="[\d.]+mm"', "", svg)
    data = bytes(resvg_py.svg_to_bytes(svg_string=svg, width=WIDTH, background="white"))
    return Image.open(io.BytesIO(data)).convert("L")


def main():
    for name, function, pair in pictures():
        images, cells = [], []
        for draw in pair:
            started = time.perf_counter()
            svg = draw()
            seconds = time.perf_counter() - started
            images.append(raster(svg))
            count = len(re.findall(r"<(?:path|polyline|circle|ellipse|line)\b", svg))
            cells.append(f"{seconds:.2f} s, {count:,} elements, {len(svg) / 1000:,.0f} kB")
        height = max(image.height for image in images)
        sheet = Image.new("L", (2 * WIDTH + 20, height + CAPTION), 255)
        for x, image, caption in zip((0, WIDTH + 20), images, (function.partition(",")[0], "hlr"), strict=True):
            sheet.paste(image, (x, CAPTION))
            ImageDraw.Draw(sheet).text((x + 6, 6), caption, fill=0)
        sheet.quantize(16).save(HERE / f"{name}.png", optimize=True)
        print(f"| {name} | {function} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
