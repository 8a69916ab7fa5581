"""Touch probe cycles of the TNC 620, a file a kind: alignment, presets, inspection, calibration, tool measurement."""
