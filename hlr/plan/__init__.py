"""The request, and what scene and request call for."""
