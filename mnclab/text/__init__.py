"""What a programmer wrote: characters, words, blocks, and the faults found in them.

The first floor of the house: it imports the standard library and numpy, nothing of ours.
A new notation inside words goes beside `expression`; a new *language* is a control and lives in `controls`.
"""
