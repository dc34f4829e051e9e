"""The price list: what accuracy costs, beside OpenCASCADE, a z-buffer, and predicates that round.

Each point is measured in a process of its own (`child`), all draw the same view at the same scale, and all are judged
by the same true lines (`judge`).
"""
