"""Drawing with matplotlib: a file for each thing that is drawn.

``colours`` is the one table of lines and marks, ``picture`` the figure that shows itself in Jupyter and how views stand
in it, ``path`` the tool path: ``strokes`` are its points, ``classes`` which of them share a colour, ``scale`` explains
the colours, ``arrows`` and ``datums`` are arrowheads and the crosses at zero points and poles; ``profile`` is the feed
over time. The only folder that imports matplotlib, and of that never ``pyplot``: figures are plain objects, so that
they can be drawn in any thread. A new picture is a file here, takes ``ax=None`` and draws with ``colours``; it may
import every floor but ``machine`` and ``controls``.
"""
