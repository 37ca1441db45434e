"""Trained policies beside belts, strokes and other rivals."""
