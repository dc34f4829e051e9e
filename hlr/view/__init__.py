"""Cameras, named views, clipping and scale."""
