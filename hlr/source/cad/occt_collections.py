"""OpenCASCADE's collection classes under one name each, for its Python bindings of versions 7 and 8.

The bindings of version 8 have all collections in one module, those of version 7 in many packages.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import Any

COLLECTION_CLASSES = {
    "shape_map": ("IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher", "TopTools.TopTools_IndexedMapOfShape"),
    "ancestor_map": (
        "IndexedDataMap_TopoDS_Shape_List_TopoDS_Shape_TopTools_ShapeMapHasher",
        "TopTools.TopTools_IndexedDataMapOfShapeListOfShape",
    ),
    "shapes": ("List_TopoDS_Shape", "TopTools.TopTools_ListOfShape"),
    "labels": ("Sequence_TDF_Label", "TDF.TDF_LabelSequence"),
    "attributes": ("Sequence_TDF_Attribute", "TDF.TDF_AttributeSequence"),
    "points": ("Array1_gp_Pnt", "TColgp.TColgp_Array1OfPnt"),
    "point_net": ("Array2_gp_Pnt", "TColgp.TColgp_Array2OfPnt"),
    "reals": ("Array1_double", "TColStd.TColStd_Array1OfReal"),
    "integers": ("Array1_int", "TColStd.TColStd_Array1OfInteger"),
}
"""For each kind: the name in OCP.collections (version 8), and package and name in version 7."""


def new_collection(kind: str, *arguments: Any) -> Any:
    """A new collection of a kind in COLLECTION_CLASSES. `arguments`: those of the constructor."""
    return _class(kind)(*arguments)


@cache
def _class(kind: str) -> Any:
    new, old = COLLECTION_CLASSES[kind]
    try:
        return getattr(import_module("OCP.collections"), new)
    except ModuleNotFoundError:
        package, name = old.split(".")
        return getattr(import_module(f"OCP.{package}"), name)
