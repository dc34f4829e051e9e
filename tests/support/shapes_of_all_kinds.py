"""Shapes of all kinds, placed, mirrored, scaled, nested and inside out; and what the kernel's model says of shapes."""

import numpy as np
import pytest


def placed(shape, *, mirrored=False, scale=1.0):
    from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    move, turn, other = gp_Trsf(), gp_Trsf(), gp_Trsf()
    move.SetTranslation(gp_Vec(1, 20, 3))
    turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 2)), 0.7)
    if mirrored:
        other.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(1, 1, 0.3)))
    else:
        other.SetScaleFactor(scale)
    for each in (move, turn, other):
        shape = shape.Moved(TopLoc_Location(each), False)
    return shape


def shapes():
    cq = pytest.importorskip("cadquery")
    from hlr.source.cad.shapes import make_compound

    box = cq.Workplane().box(4, 3, 2)
    rounded = box.edges().fillet(0.4).val().wrapped
    torus, ball = cq.Solid.makeTorus(5, 1).wrapped, cq.Solid.makeSphere(2, angleDegrees1=-30).wrapped
    wavy = cq.Workplane().spline([(0, 0), (2, 1), (4, -1), (6, 0)]).lineTo(6, 4).lineTo(0, 4).close().extrude(3)
    turned = cq.Workplane("XZ").moveTo(2, 0).spline([(3, 1), (2, 3)], includeCurrent=True).lineTo(0, 3).lineTo(0, 0)
    turned = turned.close().revolve(200, (0, 0, 0), (0, 1, 0)).val().wrapped
    grid = [[cq.Vector(x, y, np.sin(x) * np.cos(y)) for y in range(6)] for x in range(6)]
    sheet = cq.Face.makeSplineApprox(grid).wrapped
    ring = cq.Wire.makeCircle(2, cq.Vector(), cq.Vector(0, 0, 1)).wrapped
    shell = box.val().Shells()[0].wrapped
    block = box.val().wrapped
    inner = make_compound([block, placed(block), ring, placed(sheet)])
    return {
        "box": block,
        "rounded": rounded,
        "torus": torus,
        "ball": placed(ball),
        "wavy": wavy.val().wrapped,
        "turned": turned,
        "sheet": sheet,
        "mirrored": placed(rounded, mirrored=True),
        "scaled": placed(rounded, scale=1.5),
        "reversed": block.Reversed(),
        "both ways round": make_compound([block, placed(block.Reversed()), placed(block)]),
        "shell": placed(shell),
        "wire": placed(ring),
        "compound": placed(make_compound([inner, placed(inner, mirrored=True), torus])),
        "empty": make_compound([]),
    }


def tables(model):
    edges = model.counts()[:, 1]
    part = np.repeat(np.arange(len(edges), dtype=np.int32), edges)
    number = np.concatenate([np.arange(count, dtype=np.int32) for count in edges])
    surfaces = model.surface_records(np.arange(model.n_faces, dtype=np.int32))
    return [model.counts(), model.boxes(), *surfaces, *model.edge_curves(part, number)]
