"""What the commands of the shell share, and those that are more than a door; the commands stand in `mnclab.__main__`."""
