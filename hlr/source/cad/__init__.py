"""Models with a B-rep: STEP, IGES and BREP files, scripts, objects of CadQuery and build123d."""
