"""The parts put together. What it imports from this repository counts as changed with it."""

import cadquery as cq
from parts import bracket, bush, plate

result = (
    cq.Assembly(name="bearing")
    .add(plate.result, name="plate", color=cq.Color("gray"))
    .add(bracket.result, name="bracket", loc=cq.Location((-20, 20, 4)), color=cq.Color("steelblue"))
    .add(bush.result, name="bush", loc=cq.Location((-15, 0, 46), (0, 1, 0), 90), color=cq.Color("orange"))
)
