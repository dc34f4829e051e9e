"""Drop-in replacements: what CadQuery, build123d and FreeCAD call a projection, drawn by hlr.

One module per neighbour, under the neighbour's own names, arguments and results. Importing one loads neither the
neighbour nor OpenCASCADE; calling it does.
"""
