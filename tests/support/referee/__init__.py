"""The referee, independent on purpose: it imports nothing of hlr, and reads files and meshes models by itself.

A mistake that hlr and its judge share would not be found. So the reader of drawings (`exchange`), the mesh of a model
(`reference`), the judged points (`judge`) and the depth image (`depth`) share no code with hlr, though hlr and its lab
have code for each of these. `python -m peers.referee` runs the referee; a test checks its independence.
"""
