"""Files of drawings and pictures: SVG, PDF, JSON, PNG; and drawings read back from JSON."""
