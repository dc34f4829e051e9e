"""What every room uses, and what knows nothing of drawings: clocks, values, processes."""
