"""What can be compared, read into lines: each format is a row of the table in `sides.py`."""
