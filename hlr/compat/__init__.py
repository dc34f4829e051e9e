"""Drop-in replacements for the projections of CadQuery, build123d and FreeCAD, drawn by hlr.

One module per program, with its names, arguments and results. Importing a module loads neither the program nor
OpenCASCADE; calling a function does.
"""
