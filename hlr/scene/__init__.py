"""All parts in one set of arrays, checked and repaired."""
