"""The shaded picture: scene and camera become pixels, a depth map and a map of parts."""
