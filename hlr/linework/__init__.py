"""Segments become lines: chained, merged, cleaned, tied to part, edge and face."""
