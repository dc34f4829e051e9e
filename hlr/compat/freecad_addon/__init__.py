"""The add-on for FreeCAD: a command and a macro that draw a TechDraw page, or what is selected, exactly.

`python -m hlr.compat.freecad_addon` installs it. `exact` has the functions behind the command, for scripts.
"""
