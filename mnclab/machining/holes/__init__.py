"""Holes: drilled, bored, tapped, milled."""
