"""Turning: roughing, grooves, threads."""
