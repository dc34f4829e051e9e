"""TechDraw pages of FreeCAD documents: each view drawn by itself and put at its place, with sections and details."""
