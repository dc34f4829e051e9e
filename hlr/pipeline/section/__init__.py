"""Sections: a model cut by a plane across the view, and its cut faces hatched."""
