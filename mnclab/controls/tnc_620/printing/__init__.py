"""Texts that a program writes, FN 15 and FN 16."""
