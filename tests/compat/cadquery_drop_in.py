"""A plugin for pytest: CadQuery's own tests, with hlr's functions in the place of CadQuery's.

HLR_DROP_IN=0 leaves CadQuery's in place, to see what fails anyhow. CadQuery's source distribution comes without the
helpers of its tests: those that its tests use for drawings stand here.
"""

import importlib
import os
import sys
import types
import unittest
from pathlib import Path

MADE = []
"""Drawings that were asked for."""


def pytest_configure():
    # Without an __init__.py, the folder of the tests is a package without content.
    if not hasattr(importlib.import_module("tests"), "BaseTest"):
        sys.modules["tests"] = helpers()
    if os.environ.get("HLR_DROP_IN") == "0":
        return
    import cadquery.cq
    from cadquery.occ_impl import exporters
    from cadquery.occ_impl.exporters import svg

    from hlr.compat.cadquery import exportSVG, getSVG

    for place in (svg, exporters, cadquery.cq):
        place.getSVG = counted(getSVG)
    for place in (svg, cadquery.cq):
        place.exportSVG = counted(exportSVG)


def counted(function):
    def called(*arguments, **options):
        MADE.append(function.__name__)
        return function(*arguments, **options)

    return called


def pytest_terminal_summary(terminalreporter):
    terminalreporter.write_line(f"drawings: {len(MADE)}")


def helpers():
    """What CadQuery's tests import from their own package."""
    import cadquery as cq

    class BaseTest(unittest.TestCase):
        def assertTupleAlmostEquals(self, expected, actual, places, msg=None):  # noqa: N802
            for one, other in zip(actual, expected, strict=True):
                self.assertAlmostEqual(one, other, places, msg)

    def square():
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0)]
        return cq.Wire.makePolygon([cq.Vector(*corner) for corner in corners])

    def cube(size, centered=True):
        return cq.Workplane("XY").rect(size, size, centered=centered).extrude(size).val()

    made = types.ModuleType("tests")
    made.BaseTest = BaseTest
    made.writeStringToFile = lambda text, name: Path(name).write_text(text)
    made.readFileAsString = lambda name: Path(name).read_text()
    made.makeUnitSquareWire = square
    made.makeCube = lambda size, xycentered=True: cube(size, xycentered)
    made.makeUnitCube = lambda centered=True: cube(1, centered)
    made.toTuple = lambda v: v.toTuple()
    return made
