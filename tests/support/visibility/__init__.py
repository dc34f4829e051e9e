"""Hidden and visible, decided twice: random scenes, the kernel, and an exact oracle that shares nothing with it."""
