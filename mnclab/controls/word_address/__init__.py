"""What controls of the G-word family share: the reader, motion, work offsets, spindle and tool words.

Plain functions of a machine and its words; each control registers them under its own codes, in its own groups and
phases. May import everything below `controls`, and no control.
"""
