// The points of the path that a place of the screen may mean: ends and middles of moves, centres of arcs, places on a move.

const CLOSE = 12;  // pixels that a move must be long on the screen, so that its points do not hide all else

class PathPoints {
  constructor(run, strokes, camera) {
    Object.assign(this, {run, path: run.path, strokes, camera});
  }
  // The place of the nearest move that is nearest to it.
  on(x, y, within, rapids) {
    const {path, strokes, camera, run} = this, row = strokes.pick(x, y, camera, within, rapids);
    if (row < 0) return [];
    const away = share => {
      const [px, py] = camera.project(path.point(row, share));
      return Math.hypot(px - x, py - y);
    };
    let best = 0;
    for (let k = 1; k <= 64; k++) if (away(k / 64) < away(best)) best = k / 64;
    let [low, high] = [Math.max(best - 1 / 64, 0), Math.min(best + 1 / 64, 1)];
    for (let k = 0; k < 60; k++) {
      const [one, other] = [low + (high - low) / 3, high - (high - low) / 3];
      if (away(one) < away(other)) high = other; else low = one;
    }
    const [dx, dy] = [0, run.lathe ? 2 : 1].map(k => path.vertex(row + 1)[k] - path.vertex(row)[k]), long = Math.hypot(dx, dy);
    const straight = path.arc[row] < 0 && !run.loose.has(row) && long > 1e-9, at = path.point(row, (low + high) / 2);
    return run.loose.has(row) ? [] : [{what: "on a move", cost: WALL, at, round: this.round(row), along: straight && [dx / long, dy / long]}];
  }
  round(row) {
    const {path} = this, arc = path.arc[row], start = path.vertex(row);
    return arc >= 0 && {d: 2 * path.radius(row), path: true,
      centre: path.centre.map((column, k) => Math.abs(path.axis.value(arc)[k]) > 0.5 ? start[k] : column[arc])};
  }
  near(x, y, within, rapids) {
    const {path, strokes: {sx, sy, after}, camera} = this, found = [];
    const add = (what, cost, at, round) => {
      const [px, py] = camera.project(at);
      if (Math.hypot(px - x, py - y) <= within) found.push({what, cost, at, round});
    };
    const close = k => Math.abs(sx[k] - x) < within && Math.abs(sy[k] - y) < within;
    for (let row = 0; row < path.n; row++) {
      const kind = path.kind[row], arc = path.arc[row];
      if (kind > PROBE || (kind === RAPID && !rapids)) continue;
      const [a, b] = [path.vertex(row), path.vertex(row + 1)], radius = arc < 0 ? 0 : path.radius(row);
      const wide = camera.zoom * (radius || Math.hypot(...a.map((v, k) => b[k] - v)));
      if (wide < CLOSE) continue;
      if (close(after[row])) add("end of a move", POINT, a);
      if (close(after[row + 1])) add("end of a move", POINT, b);
      if (kind !== LINE && kind !== ARC) continue;
      const round = this.round(row);
      add("middle of a move", MIDDLE, path.point(row, 0.5), round);
      if (round) add("centre of an arc", POINT, round.centre, round);
    }
    return found;
  }
}
