"""Datum and point tables of the TNC, as files."""
