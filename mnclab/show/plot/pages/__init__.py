"""A document on pages of A4, as a PDF whose bytes are the same every time."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import matplotlib as mpl
from matplotlib.backends.backend_pdf import PdfPages

from mnclab.show.given_away import whole
from mnclab.show.plot.pages.setting import sheets
from mnclab.show.report.contents import Document


def write(document: Document, path: Path) -> None:
    """Write the pages; the same document gives the same bytes."""
    data = BytesIO()
    undated = {"CreationDate": None, "Title": whole(document.title)}
    with mpl.rc_context({"pdf.fonttype": 42}), PdfPages(data, metadata=undated) as pages:
        for sheet in sheets(document):
            pages.savefig(sheet)
    path.write_bytes(data.getvalue())
