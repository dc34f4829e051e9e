"""What is asked for: options and their check, the accuracy and all that follows from it, the tables of effects."""
