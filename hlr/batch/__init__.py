"""Batches: many sources drawn by warm workers, what is unchanged left alone, and a report of it all."""
