"""Visibility decided twice on random scenes: by the kernel, and by an exact oracle that shares no code with it."""
