"""Touch probe cycles of the TNC 620: a file for each chapter, or for the figures of one."""
