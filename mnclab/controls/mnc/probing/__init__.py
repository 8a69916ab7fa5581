"""Measuring cycles of the MNC (chapter 12), a file a kind: alignment, datums, measuring, single touches, calibration."""
