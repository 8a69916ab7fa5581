// The surface of a milled part under a place of the picture. A ray through the map of heights finds where to look; what is
// measured there are the moves that cut (see swept.js) and the sides of the blank, so that it does not know of cells.

const ASIDE = 0.01;  // mm off an edge, where its two heights are taken
const LEAST = 0.002;  // mm that they differ at least
const ALONG = 0.05;  // mm from a corner, where its edges are looked for
const AROUND = 400;  // cells of a wall that a circle is laid through

class Surface {
  constructor(carving) {
    Object.assign(this, {carving, grid: carving.grid, blank: carving.frames[0].map});
    this.low = [...this.grid.low, carving.depths[0]];
    this.high = [...this.grid.high, carving.depths[1]];
    const on = (axis, side) => carving.run.stock.some(edge => edge.some((point, k) => k && [edge[k - 1], point].every(each => Math.abs(each[axis] - side) < 1e-3)
      && Math.abs(edge[k - 1][1 - axis] - point[1 - axis]) > this.grid.step));
    this.sides = [this.low, this.high].flatMap(([x, y]) => [on(0, x) && {x, y, ux: 0, uy: 1}, on(1, y) && {x, y, ux: 1, uy: 0}]).filter(Boolean);
  }
  cell(x, axis) {
    return Math.min(Math.max(Math.floor((x - this.low[axis]) / this.grid.step), 0), (axis ? this.grid.ny : this.grid.nx) - 1);
  }
  inside(x, y) {
    return x >= this.low[0] && x <= this.high[0] && y >= this.low[1] && y <= this.high[1];
  }
  // Where the line of sight through a place of the screen meets the map: {at, wall, below}, or null.
  hit(camera, x, y) {
    const {grid, low, high} = this, from = camera.unproject(x, y), way = camera.near.map(v => Math.abs(v) < 1e-9 ? 0 : -v);
    let t = -Infinity, end = Infinity;
    for (const k of [0, 1, 2]) {
      const [a, b] = [low[k], high[k]].map(side => side - from[k]);
      if (way[k]) [t, end] = [Math.max(t, Math.min(a / way[k], b / way[k])), Math.min(end, Math.max(a / way[k], b / way[k]))];
      else if (a > 0 || b < 0) return null;
    }
    const place = s => from.map((v, k) => v + s * way[k]), sense = way.map(Math.sign);
    const cells = [0, 1].map(k => this.cell(from[k] + (t + 1e-7) * way[k], k)), wide = [grid.nx, grid.ny];
    while (t < end) {
      const sides = [0, 1].map(k => way[k] ? (low[k] + grid.step * (cells[k] + (sense[k] > 0)) - from[k]) / way[k] : Infinity);
      const axis = sides[0] < sides[1] ? 0 : 1, next = Math.min(sides[axis], end), [z, then] = [t, next].map(s => from[2] + s * way[2]);
      const top = this.carving.map.at(...cells).height, floor = grid.floor[cells[1] * grid.nx + cells[0]];
      if (top - floor > SAME) {
        if (z < top - SAME && z > floor + SAME) return {at: place(t), wall: true};
        if (z >= top - SAME && then <= top) return {at: place(t + (way[2] ? (top - z) / way[2] : 0))};
        if (z <= floor + SAME && then >= floor) return {at: place(t + (way[2] ? (floor - z) / way[2] : 0)), below: true};
      }
      t = next;
      cells[axis] += sense[axis];
      if (!(cells[axis] >= 0 && cells[axis] < wide[axis])) return null;
    }
    return null;
  }
  // Look at the moves that cut within some mm of places: `pieces` and `curves` are then what they leave behind.
  look(places, reach) {
    const {grid, carving} = this, {live, run: {path}} = carving, rows = new Set(), k = Math.min(Math.ceil(reach / grid.step) + 1, 12);
    let most = -Infinity;
    for (const [x, y] of places)
      for (let j = Math.max(this.cell(y, 1) - k, 0); j <= Math.min(this.cell(y, 1) + k, grid.ny - 1); j++)
        for (let i = Math.max(this.cell(x, 0) - k, 0); i <= Math.min(this.cell(x, 0) + k, grid.nx - 1); i++) {
          const {height, by} = carving.map.at(i, j);
          most = Math.max(most, height);
          if (by) rows.add(Math.abs(by) - 1);
        }
    const near = ({box}) => places.some(([x, y]) => x > box[0] - reach && x < box[2] + reach && y > box[1] - reach && y < box[3] + reach);
    const curves = this.curves = new Map(), keep = curve => curves.set(JSON.stringify(curve), curve);
    this.pieces = [];
    for (const row of rows) {
      const cutter = carving.cutters[carving.which.value(row)], from = carving.does.value(row) === ARRIVAL ? 1 : 0;
      const share = row < live.rows ? 1 : live.share, lift = carving.lift.value(row), arc = path.arc[row];
      this.pieces.push(...carving.pieces(row, from, share).map(make => make(cutter)).filter(near));
      const ends = [from, share].map(s => path.point(row, s)), [a, b] = ends, [dx, dy] = [b[0] - a[0], b[1] - a[1]], long = Math.hypot(dx, dy);
      const flat = long < STILL, above = most - lift - (flat ? Math.min : Math.max)(a[2], b[2]), wide = rimRadius(cutter, above);
      const rim = wide < cutter[0] && {rim: most};
      if (!(wide > 0) || (rim && !flat && a[2] !== b[2])) continue;
      for (const [x, y] of ends) keep({x, y, r: wide, ...rim});
      if (arc < 0 && long > 2 * grid.step)
        for (const side of [-wide, wide]) keep({x: a[0] - side * dy / long, y: a[1] + side * dx / long, ux: dx / long, uy: dy / long, ...rim});
      if (arc >= 0 && Math.abs(path.axis.value(arc)[2]) > 1 - 1e-9)
        for (const side of [-wide, wide]) {
          const [x, y] = path.centre.map(column => column[arc]), r = Math.abs(path.radius(row) + side);
          if (r > 1e-6) keep({x, y, r, ...rim});
        }
    }
    this.sides.forEach(keep);
  }
  // The height at any place near those looked at; a flag says that it is only that of a cell of the blank.
  height(x, y) {
    if (!this.inside(x, y)) return {z: this.low[2]};
    const [i, j] = [this.cell(x, 0), this.cell(y, 1)], {height} = this.blank.at(i, j), floor = this.grid.floor[j * this.grid.nx + i];
    const left = this.pieces.reduce((least, piece) => Math.min(least, piece.left(x, y)), Infinity), cell = left >= height;
    const rough = cell && this.blank.slope(i, j).some(v => Math.abs(v) > 1e-6);
    return {z: Math.max(left < height ? left : height, floor), rough: rough && this.grid.step};
  }
  // Both heights of a curve at a place on it, the upper one first; null where there is no edge.
  levels({x, y, r, ux, uy, rim}, [px, py]) {
    const [nx, ny] = r ? [(px - x) / r, (py - y) / r] : [-uy, ux];
    const sides = [-ASIDE, ASIDE].map(s => this.height(px + s * nx, py + s * ny)).sort((a, b) => b.z - a.z);
    if (sides[0].z - sides[1].z < LEAST || (rim !== undefined && Math.abs(sides[0].z - rim) > LEAST)) return null;
    return {z: rim === undefined ? sides.map(side => side.z) : [rim], off: sides[0].rough};
  }
  // Corners, edges and walls at most some mm beside a place in the plane.
  near({at: [x, y, z], wall, below}, reach) {
    const {edges, corners} = snaps([...this.curves.values()], [x, y], reach, ALONG, (curve, place) => this.levels(curve, place)), found = [];
    for (const {curve, place, told} of edges) {
      const round = curve.r && {d: 2 * curve.r, centre: [curve.x, curve.y, told.z[0]]}, along = !round && [curve.ux, curve.uy];
      told.z.forEach((level, k) => found.push({what: "edge", cost: EDGE + k, at: [...place, level], round, along, off: told.off}));
      if (wall) found.push({what: "wall", cost: WALL, at: [...place, Math.min(Math.max(z, told.z[1] ?? z), told.z[0])], round, along});
    }
    for (const {place, told} of corners) {
      const all = told.flatMap(({z}) => z), off = told[0].off || told[1].off;
      [Math.max(...all), Math.min(...all)].forEach((level, k) => found.push({what: "corner", cost: CORNER + k, at: [...place, level], off}));
    }
    if (!found.length) found.push(...this.wallOfCells([x, y, z], reach));
    const {z: exact, rough} = below ? {z} : this.height(x, y);
    if (!wall) found.push({what: "surface", cost: FREE, at: [x, y, exact], off: rough});
    else if (!found.length) found.push({what: "surface", cost: FREE, at: [x, y, z], off: this.grid.step});
    return found;
  }
  // A wall that no curve tells: the nearest step between two cells, and the circle through those that continue it.
  wallOfCells([x, y, z], reach) {
    const {grid} = this, {nx, ny, step} = grid, height = (i, j) => i < 0 || j < 0 || i >= nx || j >= ny ? this.low[2] : this.carving.map.at(i, j).height;
    const k = Math.min(Math.ceil(reach / step), 12), faces = (i, j) => [[1, 0], [-1, 0], [0, 1], [0, -1]]
      .map(([di, dj]) => ({i, j, x: grid.x(i) + di * step / 2, y: grid.y(j) + dj * step / 2, low: height(i + di, j + dj)}));
    let seed = null, least = reach;
    for (let j = Math.max(this.cell(y, 1) - k, 0); j <= Math.min(this.cell(y, 1) + k, ny - 1); j++)
      for (let i = Math.max(this.cell(x, 0) - k, 0); i <= Math.min(this.cell(x, 0) + k, nx - 1); i++)
        for (const face of faces(i, j)) {
          const away = Math.hypot(face.x - x, face.y - y);
          if (away < least && height(i, j) - face.low > step) [seed, least] = [face, away];
        }
    if (!seed) return [];
    const top = height(seed.i, seed.j), level = (top + seed.low) / 2, seen = new Set(), steps = [], queue = [[seed.i, seed.j]];
    while (queue.length && seen.size < AROUND) {
      const [i, j] = queue.shift(), own = faces(i, j).filter(face => face.low < level);
      if (i < 0 || j < 0 || i >= nx || j >= ny || height(i, j) < level || !own.length || seen.has(j * nx + i)) continue;
      seen.add(j * nx + i);
      steps.push(...own);
      for (const di of [-1, 0, 1]) for (const dj of [-1, 0, 1]) queue.push([i + di, j + dj]);
    }
    const circle = circleThrough(steps.map(face => [face.x, face.y])), round = steps.length > 11 && circle.off < step && circle;
    return [top, Math.min(Math.max(z, seed.low), top)].map((height, wall) => ({
      what: wall ? "wall" : "edge", cost: wall ? WALL : EDGE, at: [seed.x, seed.y, height], off: step, round: round && {d: round.d, centre: [...round.centre, top], off: step}}));
  }
}

// How far from its axis a cutter reaches at a height above its tip.
function rimRadius([radius, flat, corner, slope], above) {
  if (above <= 0) return 0;
  if (slope > 0) return Math.min(radius, flat + above / slope);
  return above >= corner ? radius : flat + Math.sqrt(corner * corner - (corner - above) ** 2);
}
