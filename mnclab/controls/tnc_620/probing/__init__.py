"""Touch probe cycles of the TNC 620: a file a chapter. Preset so far only in one axis (419)."""
