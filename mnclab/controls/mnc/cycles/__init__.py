"""The cycles of the MNC control: those that run at each position until G80, and those that are prepared and called."""
