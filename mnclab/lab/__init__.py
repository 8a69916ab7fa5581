"""Where programs are typed and tried: forms, panels, editor, magics, completion, sketches.

A wing: it sees all of the house, and no other room imports it.
"""

from importlib.resources import files


def languages() -> str:
    """The colours of programs in JupyterLab, a module of JavaScript."""
    return files("mnclab.lab").joinpath("labextension/static/languages.js").read_text("utf-8")
