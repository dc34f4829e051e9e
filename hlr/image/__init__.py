"""A scene before one camera: placed on paper, cut off behind the eye, with its outlines."""
