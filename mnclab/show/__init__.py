"""What people see and take away: pictures, forms, files.

`plot` draws with matplotlib, `scene` with pyvista, `player` makes a page that needs nothing, `export` writes files, `forms`
and `editor` build boxes and live pictures with ipywidgets, `magic` is the cell magic.

Pictures and files know data (paths, profiles, blanks) and never import `machine`, `running`, `runs` or `controls`; only
`forms`, `editor` and `magic` see all. A new kind of picture is a file in `plot`; a new kind of file is a function and its
line in `export.WRITERS`.
"""
