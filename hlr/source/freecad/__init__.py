"""FreeCAD's documents, read without FreeCAD."""
