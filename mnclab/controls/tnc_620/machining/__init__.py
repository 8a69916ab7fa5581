"""How the cycles of the TNC 620 alone cut: contour trains, cylinders, studs, engraving, thread milling."""
