"""The window of a drawing: what lies in a rectangle on paper, cut at its sides after hiding.

Nothing is left out before visibility is decided: what lies outside still hides what lies inside. `cut.py` decides
whether there is anything to cut; `lines.py` cuts lines and curves (`tracks.py`: where they pass a side); `fill.py` cuts
faces.
"""
