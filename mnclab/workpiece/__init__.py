"""What the tool meets: the blank, and the part that a probe touches.

May import `text`, `geometry` and `path`; knows neither strategies nor machines. A new way to describe material is a new
file here.
"""
