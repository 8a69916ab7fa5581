"""Where programs are typed and tried: forms, panels, editor, magics, completion, sketches.

A wing: it sees all of the house, and no other room imports it.
"""
