"""What people look at: the picture of a comparison, and its table."""
