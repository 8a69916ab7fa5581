"""What people see and take away: pictures, pages, files.

`plot` draws with matplotlib, `scene` with pyvista, `player` makes a page that needs nothing, `report` makes pages to print,
`export` writes files. `looks` says how moves and materials look, `probed` is what a probe met, for all of them.

Pictures and files know data (paths, profiles, blanks) and never import `machine`, `running`, `runs` or `controls`. A new kind
of picture is a file in `plot`; a new kind of file is a function and its line in `export.WRITERS`.
"""
