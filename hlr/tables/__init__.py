"""The tables of line classes, readers and writers. A new one is a new row, and every stage reads the row."""
