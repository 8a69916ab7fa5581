"""Random designs for drawings: milled ones with features side by side in the cells of a grid, stepped shafts and bushes."""

import math
import random

from mnclab.design import model as d


def milled(seed):
    """A design with up to nine features in front, sometimes some at the back."""
    dice = random.Random(seed)
    nx, ny = dice.choice([(2, 1), (2, 2), (3, 2), (3, 3)])
    cell = dice.choice([20, 25, 30, 40])
    high = dice.choice([12, 18, 25])
    x0, y0, z1 = dice.choice([(0, 0, 0), (0, 0, high), (-nx * cell / 2, -ny * cell / 2, 0), (10, 5, 0)])
    blank = ((x0, y0, z1 - high), (x0 + nx * cell, y0 + ny * cell, z1))
    front = [_feature(dice, x0 + (i + 0.5) * cell, y0 + (k + 0.5) * cell, cell, high) for i in range(nx) for k in range(ny)]
    if dice.random() < 0.3:
        front.append(d.Chamfer(d.Rectangle(x0 + nx * cell / 2, y0 + ny * cell / 2, nx * cell, ny * cell), 1))
    if dice.random() < 0.2:
        front = [d.Face(1)] + [each for each in front if not isinstance(each, d.Chamfer)]
    back = ()
    if dice.random() < 0.2:
        ends = _slot(x0 + cell * 1.5, y0 + cell / 2, cell, 0)
        back = (d.Pocket.circle(x0 + cell / 2, y0 + cell / 2, 0.5 * cell, 2), d.Slot(*ends, 4, 3))
    return d.Design(blank, tuple(front), back, title=f"Part {seed}", material=dice.choice(["", "S235", "EN AW-6082"]))


def turned(seed):
    """A stepped part of two to five cylinders with grooves, threads, bores."""
    dice = random.Random(seed)
    rising = sorted(dice.sample(range(10, 40), dice.randint(2, 5)))
    if len(rising) > 3:
        rising[-1], rising[-2] = rising[-2], rising[-1]
    points, z = [], 0.0
    for r in rising:
        long = dice.choice([12, 15, 20.5])
        points += [(z, r), (z - long, r)]
        z -= long
    features, chamfers = [], {0: dice.choice([0.5, 1, 1.5])}
    if dice.random() < 0.5:
        features.append(d.RingGroove(-7, 3, depth=1.5, corner=dice.choice([0, 0.4])))
    kind = dice.choice(["solid", "centred", "bore", "stepped", "nut"])
    if kind == "centred":
        features += [d.CentreHole(2.5), d.CentreHole(2, from_end="back")]
    if kind in ("bore", "stepped"):
        features.append(d.Bore(8, dice.choice([None, 15]), tolerances={"diameter": "H7"} if dice.random() < 0.5 else {}))
    if kind == "stepped":
        features.append(d.Bore(12, 6, point=180, chamfer=0.5))
    if kind == "nut":
        features += [d.Bore(10.2, None), d.Thread("M12", 0, -10, inside=True)]
    if dice.random() < 0.4:
        features.append(d.Thread(f"M{2 * rising[0]}x1", 0, -5))
    roundings = {3: 1} if dice.random() < 0.5 else {}
    tolerances = {"diameter 2": "h6"} if dice.random() < 0.5 else {}
    return d.TurnedDesign(
        points, tuple(features), chamfers=chamfers, roundings=roundings, tolerances=tolerances, title=f"Shaft {seed}"
    )


def _feature(dice, x, y, cell, high):
    x, y = x + dice.choice([0, 0, 1, -1]), y + dice.choice([0, 0, 1, -1.5])
    deep = dice.choice([2, 3, 4.5])
    kind = dice.choice("circle rectangle turned slot tilted groove hole hole hole thread bored sunk outline".split())
    wide = 0.55 * cell
    tolerances = {"depth": dice.choice([0.05, (0, 0.1), (-0.2, -0.1)])} if dice.random() < 0.15 else {}
    if kind == "circle":
        return d.Pocket.circle(x, y, wide, deep, tolerances={"diameter": "H7"} if dice.random() < 0.3 else tolerances)
    if kind == "rectangle":
        return d.Pocket.rectangle(x, y, wide, 0.4 * cell, deep, corner=dice.choice([0, 2, 3]), tolerances=tolerances)
    if kind == "turned":
        return d.Pocket.rectangle(x, y, wide, 0.3 * cell, deep, corner=2, turned=dice.choice([20, 45, 60, -30]))
    if kind == "slot":
        return d.Slot(*_slot(x, y, cell, dice.choice([0, 90])), 0.2 * cell, deep)
    if kind == "tilted":
        return d.Slot(*_slot(x, y, cell, dice.choice([30, 135])), 0.2 * cell, deep)
    if kind == "groove":
        return d.Groove(d.Circle(x, y, 0.4 * cell), 2, deep)
    if kind == "thread":
        return d.Hole(x, y, None, dice.choice([None, 0.7 * high]), thread=dice.choice(["M6", "M8", "M8x1"]), tolerances={})
    if kind == "bored":
        return d.Hole(x, y, 5.5, None, counterbore=(10, 4))
    if kind == "sunk":
        return d.Hole(x, y, 5.5, dice.choice([None, 9]), countersink=(10.4, 90))
    if kind == "outline":
        a = wide / 2
        bulge = (0, 0, math.tan(math.pi / 8), 0, 0)
        return d.Pocket(d.Outline(((x - a, y - a), (x + a, y - a), (x + a, y), (x, y + a), (x - a, y + a)), bulge), deep)
    return d.Hole(x, y, dice.choice([4, 5, 6.6]), dice.choice([None, 8]), point=dice.choice([118, 118, 140, 180]))


def _slot(x, y, cell, degrees):
    c, s = 0.2 * cell * math.cos(math.radians(degrees)), 0.2 * cell * math.sin(math.radians(degrees))
    return (x - c, y - s), (x + c, y + s)
