"""What the drop-ins are compared with: OpenCASCADE's exact hidden-line removal, called as the neighbours call it."""

from itertools import pairwise

from hlr.lab.rivals.opencascade import ExactAlgo
from hlr.source.cad.occt_import import load_occt

NAMES = ("V", "Rg1LineV", "RgNLineV", "OutLineV", "IsoLineV", "H", "Rg1LineH", "RgNLineH", "OutLineH", "IsoLineH")


def project_ex(shape, direction):
    """The ten compounds of FreeCAD's TechDraw.projectEx; None where there are no lines."""
    load_occt()
    from OCP.BRepLib import BRepLib

    found = ExactAlgo(shape, direction)
    found.hide()
    found.extract()
    compounds = []
    for name in NAMES:
        lines = getattr(found.result, f"{name}Compound")()
        if lines.IsNull():
            lines = None
        else:
            BRepLib.BuildCurves3d_s(lines, 1e-3)
        compounds.append(lines)
    return compounds


def length(shape):
    """Of all edges together; 0 for None. In pieces: of a whole flat ellipse at once OpenCASCADE is 1 % off."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GCPnts import GCPnts_AbscissaPoint
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    total = 0.0
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_EDGE) if shape is not None else None
    while explorer is not None and explorer.More():
        curve = BRepAdaptor_Curve(TopoDS.Edge(explorer.Current()))
        first, last = curve.FirstParameter(), curve.LastParameter()
        ends = [first + (last - first) * i / PIECES for i in range(PIECES + 1)]
        total += sum(GCPnts_AbscissaPoint.Length_s(curve, a, b) for a, b in pairwise(ends))
        explorer.Next()
    return total


PIECES = 8


def box(shapes):
    """(x0, y0, z0, x1, y1, z1) around the true curves of some shapes."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    bounds = Bnd_Box()
    for shape in shapes:
        if shape is not None:
            BRepBndLib.AddOptimal_s(shape, bounds, False, False)
    bounds.SetGap(0.0)
    return (*bounds.CornerMin().Coord(), *bounds.CornerMax().Coord())
