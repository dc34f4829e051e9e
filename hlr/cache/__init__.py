"""A folder in which something that took long to find out is kept, and found again."""
