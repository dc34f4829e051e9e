"""The window of a drawing: lines and fill are cut at the sides of a rectangle on paper, after hidden lines are removed.

Visibility is decided for the whole model: geometry outside the window still hides geometry inside it. `cut.py` decides
whether there is anything to cut; `lines.py` cuts lines and curves; `tracks.py` finds where they cross a side; `fill.py`
cuts faces.
"""
