// The points of the path that a place of the screen may mean: ends and middles of moves, centres of arcs.

const CLOSE = 12;  // pixels that a move must be long on the screen, so that its points do not hide all else

class PathPoints {
  constructor(run, strokes, camera) {
    Object.assign(this, {path: run.path, strokes, camera});
  }
  near(x, y, within) {
    const {path, strokes: {sx, sy, after}, camera} = this, found = [];
    const add = (what, cost, at, round) => {
      const [px, py] = camera.project(at);
      if (Math.hypot(px - x, py - y) <= within) found.push({what, cost, at, round});
    };
    const close = k => Math.abs(sx[k] - x) < within && Math.abs(sy[k] - y) < within;
    for (let row = 0; row < path.n; row++) {
      const kind = path.kind[row], arc = path.arc[row];
      if (kind > PROBE) continue;
      const [a, b] = [path.vertex(row), path.vertex(row + 1)], radius = arc < 0 ? 0 : path.radius(row);
      const wide = camera.zoom * (radius || Math.hypot(...a.map((v, k) => b[k] - v)));
      if (wide < CLOSE) continue;
      if (close(after[row])) add("end of a move", POINT, a);
      if (close(after[row + 1])) add("end of a move", POINT, b);
      if (kind !== LINE && kind !== ARC) continue;
      const round = radius && {d: 2 * radius, centre: path.centre.map((column, k) => Math.abs(path.axis.value(arc)[k]) > 0.5 ? a[k] : column[arc]), path: true};
      add("middle of a move", MIDDLE, path.point(row, 0.5), round);
      if (round) add("centre of an arc", POINT, round.centre, round);
    }
    return found;
  }
}
