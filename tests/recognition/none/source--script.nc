import math

def circle(r):
    return [f"G1 X{r}" for _ in range(4)]
