"""Visibility: from an image and its plan to visible and hidden segments."""
