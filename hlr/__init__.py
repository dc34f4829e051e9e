"""Hidden-line drawings of CAD models."""
