"""What tests of sections cut, and what they look at in the drawing."""

import cadquery as cq
import numpy as np
import trimesh

import hlr
from hlr.source.cad.kernel_cut import KernelCut

WIDTH, DEPTH, HEIGHT, RADIUS = 60.0, 30.0, 40.0, 10.0


def plate():
    """A block with a hole from top to bottom, its middle in the origin."""
    return cq.Workplane().box(WIDTH, DEPTH, HEIGHT).faces(">Z").workplane().hole(2 * RADIUS)


def mesh_of(thing):
    points, triangles = thing.val().tessellate(0.01, 0.05)
    return np.array([p.toTuple() for p in points]), np.array(triangles)


def section(thing, view="front", where=True, **options):
    return hlr.draw(thing, view, section=where, **{"scale": 1, **options})


def hatch_of(drawing):
    """(n, 2, 2)"""
    return np.array([line.points for line in drawing.lines if line.kind == "hatch"]).reshape(-1, 2, 2)


def hatched_area(drawing, spacing):
    way = hatch_of(drawing) @ [1, 1j]
    return float(np.abs(way[:, 1] - way[:, 0]).sum() * spacing)


def measured_area(drawing):
    """Square millimetres of the model, by the length of the hatch and the distance of its lines, whatever that is."""
    ends = hatch_of(drawing)
    ways = ends[:, 1] - ends[:, 0]
    across = np.array([-ways[0, 1], ways[0, 0]]) / np.linalg.norm(ways[0])
    apart = np.diff(np.unique((ends[:, 0] @ across).round(6)))
    return float(np.linalg.norm(ways, axis=1).sum() * apart[apart > 0.01].min()) / drawing.scale**2


def assembled(bodies, meshed):
    """An assembly of bodies by name, or a scene of their meshes."""
    thing = trimesh.Scene() if meshed else cq.Assembly()
    for name, body in bodies.items():
        if meshed:
            thing.add_geometry(trimesh.Trimesh(*mesh_of(body)), geom_name=name, node_name=name)
        else:
            thing.add(body, name=name)
    return thing


def outlines_of(drawing):
    """The straight lines that are no hatch, by their ends, to a thousandth of a millimetre."""
    found = set()
    for line in drawing.lines:
        if line.kind != "hatch":
            ends = sorted(tuple(np.round(line.points[k], 3).tolist()) for k in (0, -1))
            found.add((line.visible, *ends))
    return found


def opencascade_cuts(monkeypatch):
    """Sections are cut by OpenCASCADE, as where the kernel cannot."""
    from hlr.pipeline.section import sources

    monkeypatch.setattr(sources, "KernelCut", lambda *asked: KernelCut(*asked[:3], ()))
