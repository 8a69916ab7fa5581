"""What people see and take away: pictures, forms, files.

`plot` draws with matplotlib, `player` makes a page that needs nothing, `export` writes files, `forms` builds boxes
and live pictures with ipywidgets. Still to come: `scene` (pyvista), `magic` (the cell magic).

Pictures and files know data (paths, profiles, stock) and never import `machine` or `controls`; only `forms` and
`magic` see all. A new kind of picture is a file in `plot`; a new kind of file is one line in `export.WRITERS`.
"""
