"""Lines of drawings as straight pieces in arrays."""
