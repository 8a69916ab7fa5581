"""What the tool does: a table of moves in columns, and passes that turn one table into another.

May import `text` and `geometry`. A new pass (columns in, columns out) is a file of its own here; a new column is one
line in `toolpath.Columns`.
"""
