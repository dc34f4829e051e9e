"""Quarters of discs, segments, polygons and spheres: corners on one circle, boxes that are square.

One in a hundred made OpenCASCADE's Delabella crash or run on for ever; hence a hundred of each, in a process of
their own that may die.
"""

import subprocess
import sys

import pytest

pytest.importorskip("cadquery")

SHAPES = """
import math, sys
import cadquery as cq
import numpy as np
from hlr.source import open_source

def at(radius, angle):
    return cq.Vector(radius * math.cos(angle), radius * math.sin(angle))

def face(*edges):
    return cq.Face.makeFromWires(cq.Wire.assembleEdges(edges))

def arc(radius, turned=0.0):
    return cq.Edge.makeThreePointArc(*(at(radius, turned + k * math.pi / 4) for k in range(3)))

def line(a, b):
    return cq.Edge.makeLine(a, b)

def disc(radius, turned=0.0):
    a, o, b = at(radius, turned), cq.Vector(), at(radius, turned + math.pi / 2)
    return face(line(o, a), arc(radius, turned), line(b, o))

def segment(radius):
    return face(arc(radius), line(at(radius, math.pi / 2), at(radius, 0)))

def polygon(radius):
    corners = [cq.Vector(), *(at(radius, t) for t in np.linspace(0, math.pi / 2, 8 + int(radius * 3)))]
    return face(*(line(a, b) for a, b in zip(corners, corners[1:] + corners[:1])))

AREA = {disc: math.pi / 4, segment: math.pi / 4 - 0.5}
radii = np.random.default_rng(1).uniform(1, 20, 120)
"""

QUARTERS = """
for make in (disc, segment, polygon):
    print(make.__name__, flush=True)
    source = open_source(cq.Compound.makeCompound([make(radius) for radius in radii.tolist()]))
    for deflection in (0.008, 0.003) if make in AREA else (0.1,):
        meshed = source.mesh(deflection, 0.3)
        assert not meshed.notes
        area = 0.0
        for part in meshed.parts:
            p, q, r = (part.points[part.triangles[:, k]] for k in range(3))
            area += np.sqrt((np.cross(q - p, r - p) ** 2).sum(axis=1)).sum() / 2
        if make in AREA:
            exact = AREA[make] * (radii**2).sum()
            assert abs(area - exact) < 2 * deflection * radii.sum(), (area, exact)
"""

SPHERE = """
import hlr
centre = (3, -4, 5)
planes = [cq.Face.makePlane(60, 60, centre, d) for d in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
octants = cq.Workplane().sphere(10).translate(centre).val().split(*planes)
for deflection in (0.05, 0.004):
    assert len(open_source(octants).mesh(deflection, 0.2).parts) == 8
"""


def run(body):
    return subprocess.run(
        [sys.executable, "-P", "-c", SHAPES + body], capture_output=True, text=True, check=False, timeout=120
    )


@pytest.mark.slow
def test_quarters():
    done = run(QUARTERS)
    assert (done.returncode, done.stdout) == (0, "disc\nsegment\npolygon\n"), done.stderr[-500:]


@pytest.mark.slow
def test_a_sphere_cut_into_octants():
    done = run(SPHERE)
    assert done.returncode == 0, done.stderr[-500:]
