"""The shaded picture: pixels, a depth map and a map of faces from a scene and a camera."""
