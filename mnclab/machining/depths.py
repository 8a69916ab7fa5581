"""temp"""
def infeeds(surface, bottom, step=None):
    out=[]; import math
    n = 1 if not step else max(1, math.ceil((abs(bottom-surface)-1e-9)/step))
    s = 1 if bottom>surface else -1
    return tuple(bottom if k==n else surface+s*k*step for k in range(1,n+1))
