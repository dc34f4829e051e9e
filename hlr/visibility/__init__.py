"""Scene, view and plan become visible and hidden segments."""
