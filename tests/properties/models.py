"""The real models of these tests, each meshed once per run."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from properties.frozen import Frozen, freeze

DATA = Path(__file__).resolve().parents[1] / "data"
ASSEMBLY = "as1-oc-214.stp"
SCREW = "M6-1x12-countersunk-screw.step"
PLATE = "nist_ctc_01_asme1_ap242-e1.stp"
GEARS = "cube_gears.3mf"
SOUP = "soup.stl"
SOLIDS = (ASSEMBLY, SCREW, PLATE)
EVERY = (*SOLIDS, GEARS, SOUP)
FINENESS = 1000
"""Accuracies in a model's diagonal."""


@cache
def model(name: str) -> Frozen:
    return freeze(DATA / name, 2 * FINENESS)


def accuracy(frozen: Frozen) -> float:
    """The accuracy in mm for a drawing at scale 1."""
    return frozen.diagonal * frozen.frame.unit / FINENESS
