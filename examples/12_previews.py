"""Six shaded previews: colours, lines on top, shadows, glass, highlights; one stands beside the drawing of its view."""

from pathlib import Path

import cadquery as cq

import hlr

here = Path(__file__).parent
models = here / "models"


def valve():
    """A glass tube between two flanges, and what is inside."""
    flange = cq.Workplane().circle(30).extrude(6).faces(">Z").workplane().circle(21).extrude(4)
    flange = flange.faces("<Z").workplane().polarArray(25.5, 0, 360, 8).hole(5).edges("%CIRCLE and >Z").fillet(1)
    tube = cq.Workplane().circle(20).circle(18).extrude(60)
    spring = cq.Solid.sweep(
        cq.Wire.assembleEdges([cq.Edge.makeCircle(1.5, cq.Vector(10, 0, 0), cq.Vector(0, 1, 0))]),
        [],
        cq.Wire.makeHelix(8, 34, 10),
        True,
        True,
    )
    out = cq.Assembly(name="valve")
    out.add(flange, name="base", color=cq.Color(0.32, 0.36, 0.42))
    out.add(flange.mirror("XY"), name="cap", loc=cq.Location((0, 0, 72)), color=cq.Color(0.32, 0.36, 0.42))
    out.add(tube, name="tube", loc=cq.Location((0, 0, 6)), color=cq.Color(0.55, 0.8, 0.95, 0.13))
    out.add(cq.Workplane().sphere(9), name="ball", loc=cq.Location((0, 0, 56)), color=cq.Color(0.85, 0.25, 0.1))
    out.add(cq.Workplane().add(spring), name="spring", loc=cq.Location((0, 0, 12)), color=cq.Color(0.9, 0.75, 0.2))
    return out


size = (960, 720)
pictures = {
    "assembly": hlr.preview(models / "as1-oc-214.stp", size=size, edges=True, shadows=True),
    "casting": hlr.preview(
        models / "nist_ftc_06_asme1_ap242-e2.stp", view="iso-ne", size=size, edges=True, smooth=True, occlusion=True
    ),
    "screw": hlr.preview(
        models / "M6-1x12-countersunk-screw.step", view=(1, -1.5, 0.7), size=size, edges=True, specular=True
    ),
    "sponge": hlr.preview(
        models / "mengerSponge3.glb", size=size, perspective=hlr.Perspective(fov=45), occlusion=True, shadows=True
    ),
    "valve": hlr.preview(valve(), view=(1, -1.2, 0.6), size=size, edges=True, specular=True),
    "hub": hlr.preview(
        models / "nist_ctc_05_asme1_ap242-e1.stp",
        size=size,
        background="#26303c",
        perspective=hlr.Perspective(fov=40),
        shadows=True,
        occlusion=True,
    ),
}
for name, picture in pictures.items():
    picture.save(here / f"preview-{name}.png")
