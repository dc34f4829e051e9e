"""The stages in order, from a source to a drawing."""
