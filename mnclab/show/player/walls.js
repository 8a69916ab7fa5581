// Where exactly walls stand between the cells of the map. A *wall* lies on the way from the middle of a cell to that of its
// neighbour along X or Y; the share of that way is found on the moves themselves when they are taken, so that a wall
// does not know of cells. To be looked at, the middles on both sides of a wall are moved onto it: then it is upright.

const NO_WALL = -1;
const STEEP = 0.3;  // of a cell that two neighbours must differ in height to have a wall between them, if one of them is not raw
const CREASE = 0.1;  // of a cell, below which two cuts meet in a crease
const HIGH = 3;  // of a cell that they differ where there is a wall in any case: half way, if nothing tells where
const WALL_HALVINGS = 9;  // times, until the place of a wall is known
const AT_DEPTH = 2e-3;  // mm above the ground of a wall, up to which a piece may move it

// Walls where a piece ends: on the way from a low cell that it reaches to a high one that it leaves.
Heights.prototype.wall = function (piece) {
  const {grid} = this, {box, span} = piece, j0 = Math.max(grid.first(1, box[1]) - 1, 0), j1 = Math.min(grid.last(1, box[3]) + 1, grid.ny - 1);
  let seen = 0, before = null;
  const steep = STEEP * grid.step;
  for (let j = j1; j >= j0; j--) {
    const [from, to] = span(grid.y(j)), row = [Math.max(grid.first(0, from) - 1, 0), Math.min(grid.last(0, to) + 1, grid.nx - 1)];
    const [first, last] = row[0] > row[1] ? before || row : before ? [Math.min(row[0], before[0]), Math.max(row[1], before[1])] : row;
    before = row[0] > row[1] ? null : row;
    for (let i = first; i <= last; i++) {
      const {h} = this.tiles[(j >> 5) * grid.across + (i >> 5)], at = (j & 31) * TILE + (i & 31);
      const east = (i & 31) < 31 ? h[at + 1] : i + 1 < grid.nx ? this.height(i + 1, j) : h[at];
      const north = (j & 31) < 31 ? h[at + TILE] : j + 1 < grid.ny ? this.height(i, j + 1) : h[at];
      const [along, up] = [Math.abs(east - h[at]), Math.abs(north - h[at])];
      if (along > SAME && i + 1 < grid.nx && (along > steep || this.differ(i, j, 1, 0))) seen += this.between(piece, i, j, 0);
      if (up > SAME && j + 1 < grid.ny && (up > steep || this.differ(i, j, 0, 1))) seen += this.between(piece, i, j, 1);
    }
  }
  return seen;
};

// Walls that are known: twice a cell and one more along Y, and the parts of the way to its neighbour.
Heights.prototype.stand = function (places, shares) {
  const {nx, across} = this.grid;
  places.forEach((at, k) => {
    const [i, j] = [(at >> 1) % nx, (at >> 1) / nx | 0];
    this.tiles[(j >> 5) * across + (i >> 5)].walls[2 * ((j & 31) * TILE + (i & 31)) + (at & 1)] = shares[k] / 512;
  });
};

// Whether a cell and its neighbour are so different that there may be a wall.
Heights.prototype.differ = function (i, j, di, dj) {
  const {nx, ny, step} = this.grid;
  if (i + di < 0 || j + dj < 0 || i + di >= nx || j + dj >= ny) return false;
  const rise = Math.abs(this.height(i + di, j + dj) - this.height(i, j));
  return rise > STEEP * step || (rise > SAME && (this.row(i, j) === 0) !== (this.row(i + di, j + dj) === 0));
};

// Whether a cell differs so from none of its neighbours: then there is no wall about it.
Heights.prototype.open = function (i, j) {
  const {across, step, nx, ny} = this.grid, a = i & 31, b = j & 31;
  if (!a || !b || a > 30 || b > 30 || i + 1 >= nx || j + 1 >= ny)
    return !(this.differ(i, j, 1, 0) || this.differ(i, j, -1, 0) || this.differ(i, j, 0, 1) || this.differ(i, j, 0, -1));
  const {h, by} = this.tiles[(j >> 5) * across + (i >> 5)], at = b * TILE + a, here = h[at], raw = by[at] === 0, most = STEEP * step;
  const alike = n => {
    const rise = Math.abs(h[n] - here);
    return rise <= SAME || (rise <= most && (by[n] === 0) === raw);
  };
  return alike(at + 1) && alike(at - 1) && alike(at + TILE) && alike(at - TILE);
};

// The same of one cell and the next one along an axis; returns how many places were looked at.
Heights.prototype.between = function (piece, i, j, axis) {
  const {grid} = this, {nx, turn, taken} = grid, n = j * nx + i, m = axis ? n + nx : n + 1;
  const [a, b] = [this.height(i, j), axis ? this.height(i, j + 1) : this.height(i + 1, j)], up = a < b, [low, high] = up ? [a, b] : [b, a];
  if (high <= piece.low || (taken[up ? m : n] === turn && taken[up ? n : m] !== turn)) return 1;
  const k = (j >> 5) * grid.across + (i >> 5), at = 2 * ((j & 31) * TILE + (i & 31)) + axis, old = this.tiles[k].walls[at];
  if (taken[up ? m : n] === turn) {  // one slope over both
    if (old !== NO_WALL) this.writable(k).walls[at] = NO_WALL;
    return 1;
  }
  const x = grid.x(i), y = grid.y(j), left = s => axis ? piece.left(x, y + (up ? s : 1 - s) * grid.step) : piece.left(x + (up ? s : 1 - s) * grid.step, y);
  if (Math.max(left(0), grid.floor[up ? n : m]) > low + AT_DEPTH) return 2;
  let near = 0, far = 1;
  for (let halved = 0; halved < WALL_HALVINGS; halved++) {
    const middle = (near + far) / 2;
    if (left(middle) < high - SAME) near = middle; else far = middle;
  }
  if (high - left(near) < CREASE * grid.step && this.row(i, j) && (axis ? this.row(i, j + 1) : this.row(i + 1, j))) return WALL_HALVINGS + 3;
  const share = (near + far) / 2, before = up ? old : 1 - old, was = taken[up ? n : m] === turn ? grid.was[up ? n : m] : low;
  const stood = old !== NO_WALL && high - was > SAME;  // of two walls on one way the higher one counts
  if (!(stood && before >= share && high - was >= was - low)) this.writable(k).walls[at] = up ? share : 1 - share;
  return WALL_HALVINGS + 2;
};

// Whether a wall stands between a cell and a neighbour: the share of the way to it, or 0.
Heights.prototype.walled = function (i, j, di, dj) {
  if (!this.differ(i, j, di, dj)) return 0;
  const {grid} = this, [x, y] = [Math.min(i, i + di), Math.min(j, j + dj)], {walls} = this.tiles[(y >> 5) * grid.across + (x >> 5)];
  const share = walls[2 * ((y & 31) * TILE + (x & 31)) + (di ? 0 : 1)];
  if (share === NO_WALL) return Math.abs(this.beside(i, j, di, dj) - this.height(i, j)) > HIGH * grid.step ? 0.5 : 0;
  return Math.max(di + dj > 0 ? share : 1 - share, 1e-3);
};

// How far the middle of a cell is moved onto its wall, mm along X and Y, the height there, and the slopes.
Heights.prototype.moved = function (i, j) {
  const {grid: {step, nx, ny}} = this, here = this.height(i, j);
  if (i && j && i + 1 < nx && j + 1 < ny && this.open(i, j))
    return [0, 0, here, (this.height(i + 1, j) - this.height(i - 1, j)) / 2 / step, (this.height(i, j + 1) - this.height(i, j - 1)) / 2 / step];
  const rise = this.slope(i, j), [x, y] = [[1, 0], [0, 1]].map(([di, dj]) => {
    const [on, back] = [this.walled(i, j, di, dj), this.walled(i, j, -di, -dj)];
    return on && back ? 0 : step * (on || -back);
  });
  if (!x && !y) return [0, 0, here, ...rise];
  const square = x * x + y * y, [dx, dy] = x && y ? [x * y * y / square, y * x * x / square] : [x, y];  // the foot of the cell on it
  const beyond = [x && this.beside(i, j, Math.sign(x), 0), y && this.beside(i, j, 0, Math.sign(y))].filter((v, k) => [x, y][k]);
  const height = here + dx * rise[0] + dy * rise[1], low = Math.min(here, ...beyond), high = Math.max(here, ...beyond);
  return [dx, dy, Math.min(Math.max(height, low), high), ...rise];
};
