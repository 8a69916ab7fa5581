"""How programs of the ISO mill are written."""
