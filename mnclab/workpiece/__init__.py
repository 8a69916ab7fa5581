"""What the tool meets: the stock that is left, and the part that a probe touches.

Imports `mnclab.geometry` and `mnclab.path`; knows neither strategies nor machines. A new way to describe
material is a new file here.
"""
