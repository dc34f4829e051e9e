"""The cache: a folder that keeps models which were read once, so that they need not be read again."""
