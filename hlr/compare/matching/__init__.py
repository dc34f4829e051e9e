"""Registering two sets of lines, matching them by covered length, and judging what is left."""
