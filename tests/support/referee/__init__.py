"""The referee, independent on purpose: it imports nothing of hlr, and reads files and meshes models by itself.

What would be one mistake in hlr and in its judge would not be found. So the reader of drawings (`exchange`), the mesh
of a model (`reference`), the points looked at (`judge`) and the depth image (`depth`) share no code with hlr, though
hlr and its lab have their own of each. `python -m peers.referee` runs it; a test holds its independence.
"""
