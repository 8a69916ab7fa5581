"""Klartext read into blocks."""
