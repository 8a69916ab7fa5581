"""Strategies side by side: what they cut, how long it takes, how hard the tool works."""
