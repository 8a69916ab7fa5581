"""What is there after a program has run: the run, its history as people read it, questions about it."""
