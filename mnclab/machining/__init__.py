"""How metal is cut, whatever the control: numbers and contours in, numbers and contours out.

Imports `mnclab.geometry` and `mnclab.path`; knows neither workpieces, machines nor cycles. A new strategy
(a way to clear, face, turn or bore) is a new file of pure functions here.
"""
