// A map of heights in square tiles, which copies share until one of them is cut: so a whole map can be kept for little.

const TILE = 32;  // cells of a tile's side
const SAME = 1e-5;  // mm, below which nothing was taken
const THIN = 0.02;  // mm: what a rapid takes up to here, or with so little of its rim, is no rapid in the material

class Grid {  // the cells, what the blank reaches below them, and how they lie in tiles
  constructor({low, high, step, shape}, floor) {
    [this.low, this.high, this.step, this.floor] = [low, high, step, floor];
    [this.ny, this.nx] = shape;
    this.across = Math.ceil(this.nx / TILE);
    this.up = Math.ceil(this.ny / TILE);
    this.turn = 1;  // counts the pieces taken
    this.taken = new Int32Array(this.nx * this.ny);  // of each cell the last piece that took of it, and its height before
    this.was = new Float32Array(this.nx * this.ny);
  }
  x(i) {
    return this.low[0] + this.step * (i + 0.5);
  }
  y(j) {
    return this.low[1] + this.step * (j + 0.5);
  }
  // The first cell whose middle is not before a coordinate, and the last one not behind it.
  first(axis, at) {
    return Math.max(Math.ceil((at - this.low[axis]) / this.step - 0.5 - 1e-9), 0);
  }
  last(axis, at) {
    return Math.min(Math.floor((at - this.low[axis]) / this.step - 0.5 + 1e-9), (axis ? this.ny : this.nx) - 1);
  }
}

class Heights {
  constructor(grid, tiles) {
    this.grid = grid;
    this.tiles = tiles;  // each {h: heights, by: the row that cut a cell + 1, negative where it was a rapid in material, and walls}
    this.own = new Uint8Array(tiles.length);
    this.touched = new Set();  // own tiles that were cut since they were last seen
  }
  static of(grid, top) {
    const tiles = [];
    for (let tj = 0; tj < grid.up; tj++)
      for (let ti = 0; ti < grid.across; ti++) {
        const h = new Float32Array(TILE * TILE), by = new Int32Array(TILE * TILE);
        for (let j = 0; j < TILE && tj * TILE + j < grid.ny; j++)
          for (let i = 0; i < TILE && ti * TILE + i < grid.nx; i++) h[j * TILE + i] = top[(tj * TILE + j) * grid.nx + ti * TILE + i];
        tiles.push({h, by, walls: new Float32Array(2 * TILE * TILE).fill(NO_WALL)});
      }
    return new Heights(grid, tiles);
  }
  fork() {
    this.own.fill(0);
    return new Heights(this.grid, this.tiles.slice());
  }
  writable(k) {
    if (!this.own[k]) {
      const {h, by, walls} = this.tiles[k];
      this.tiles[k] = {h: h.slice(), by: by.slice(), walls: walls.slice()};
      this.own[k] = 1;
    }
    this.touched.add(k);
    return this.tiles[k];
  }
  // What is not as it was sent, and the cells beside it, whose slopes change with it: of each tile a box [first i, first j,
  // last i, last j] of its cells; so too what some `marks` have cut. `sent` has copies, and is brought up to date.
  changed(sent, marks = []) {
    const {grid: {across, nx, ny}} = this, found = new Map(), add = (i0, j0, i1, j1) => {
      for (let tj = j0 >> 5; tj <= j1 >> 5; tj++)
        for (let ti = i0 >> 5; ti <= i1 >> 5; ti++) {
          const k = tj * across + ti, [a, b, c, d] = found.get(k) || [nx, ny, 0, 0], [x, y] = [ti * TILE, tj * TILE];
          found.set(k, [Math.min(a, Math.max(i0, x)), Math.min(b, Math.max(j0, y)), Math.max(c, Math.min(i1, x + 31)), Math.max(d, Math.min(j1, y + 31))]);
        }
    };
    this.tiles.forEach((tile, k) => {
      const old = sent[k];
      if (old && old.tile === tile && !this.touched.has(k) && !marks.length) return;
      const {h, by, walls} = tile, x = k % across * TILE, y = (k / across | 0) * TILE;
      let [i0, j0, i1, j1] = old ? [TILE, TILE, -1, -1] : [0, 0, 31, 31];
      for (let n = 0; old && n < TILE * TILE; n++) {
        if (h[n] === old.h[n] && by[n] === old.by[n] && walls[2 * n] === old.walls[2 * n] && walls[2 * n + 1] === old.walls[2 * n + 1] && !marks.includes(by[n])) continue;
        [i0, j0, i1, j1] = [Math.min(i0, n & 31), Math.min(j0, n >> 5), Math.max(i1, n & 31), n >> 5];
      }
      if (old && old.tile === tile && i1 < 0) return;
      sent[k] = {tile, h: h.slice(), by: by.slice(), walls: walls.slice()};
      if (i1 >= 0) add(Math.max(x + i0 - 1, 0), Math.max(y + j0 - 1, 0), Math.min(x + i1 + 1, nx - 1), Math.min(y + j1 + 1, ny - 1));
    });
    this.touched.clear();
    return found;
  }
  // How steeply the heights rise along X and Y, measured on this side of walls.
  slope(i, j) {
    const {grid: {step}} = this, along = (di, dj) => {
      const ahead = this.walled(i, j, di, dj) ? null : this.beside(i, j, di, dj), back = this.walled(i, j, -di, -dj) ? null : this.beside(i, j, -di, -dj);
      const here = this.height(i, j);
      return ahead !== null && back !== null ? (ahead - back) / 2 / step : ahead !== null ? (ahead - here) / step : back !== null ? (here - back) / step : 0;
    };
    return [along(1, 0), along(0, 1)];
  }
  height(i, j) {
    return this.tiles[(j >> 5) * this.grid.across + (i >> 5)].h[(j & 31) * TILE + (i & 31)];
  }
  row(i, j) {
    return this.tiles[(j >> 5) * this.grid.across + (i >> 5)].by[(j & 31) * TILE + (i & 31)];
  }
  beside(i, j, di, dj) {  // the height of a neighbour, null beside the blank
    const {nx, ny} = this.grid;
    return i + di < 0 || j + dj < 0 || i + di >= nx || j + dj >= ny ? null : this.height(i + di, j + dj);
  }
  at(i, j) {
    const {grid} = this, tile = this.tiles[(j / TILE | 0) * grid.across + (i / TILE | 0)], at = j % TILE * TILE + i % TILE;
    return {height: tile.h[at], by: tile.by[at]};
  }

  over(x, y) {  // the height of the cell at a place; none beside the blank
    const {grid} = this, i = Math.floor((x - grid.low[0]) / grid.step), j = Math.floor((y - grid.low[1]) / grid.step);
    return i >= 0 && j >= 0 && i < grid.nx && j < grid.ny ? this.at(i, j).height : -Infinity;
  }

  // Take a piece of a row away; `rapid` is the same piece with a thinner cutter where the row is a rapid, `before` the map
  // before the row. Returns how many cells were looked at.
  take(piece, row, rapid = null, before = this) {
    const {grid} = this, {box, left, span} = piece, {nx} = grid, mark = row + 1;
    const j0 = grid.first(1, box[1]), j1 = grid.last(1, box[3]), turn = ++grid.turn;
    if (grid.first(0, box[0]) > grid.last(0, box[2])) return 0;
    let seen = 0, wounded = false;
    for (let j = j0; j <= j1; j++) {
      const y = grid.y(j), [from, to] = span(y), i0 = grid.first(0, from), i1 = grid.last(0, to);
      seen += Math.max(i1 - i0 + 1, 0) + 4;
      for (let i = i0; i <= i1;) {
        const ti = i / TILE | 0, k = (j / TILE | 0) * grid.across + ti, end = Math.min(i1, ti * TILE + TILE - 1);
        let tile = this.tiles[k], open = false;
        for (; i <= end; i++) {
          const at = j % TILE * TILE + i % TILE, now = tile.h[at], floor = grid.floor[j * nx + i];
          if (now <= floor || now <= piece.low) continue;
          const x = grid.x(i), height = Math.max(left(x, y, now), floor);
          if (!(height < now - SAME)) continue;
          const red = rapid && rapid.left(x, y) < before.tiles[k].h[at] - THIN;
          if (!open) [tile, open] = [this.writable(k), true];
          wounded ||= red;
          [grid.taken[j * nx + i], grid.was[j * nx + i]] = [turn, now];
          tile.h[at] = height;
          tile.by[at] = red || (rapid && tile.by[at] === -mark) ? -mark : mark;
        }
      }
    }
    if (wounded) this.wound(piece, mark);
    return seen + this.wall(piece);
  }
  // What the rim of a rapid alone has taken belongs to a wound that it is beside.
  wound({box, span}, mark) {
    const {grid: {across}, grid} = this, found = [], near = [-1, 0, 1];
    for (let j = Math.max(grid.first(1, box[1]), 1); j <= Math.min(grid.last(1, box[3]), grid.ny - 2); j++) {
      const [from, to] = span(grid.y(j));
      for (let i = Math.max(grid.first(0, from), 1); i <= Math.min(grid.last(0, to), grid.nx - 2); i++)
        if (this.row(i, j) === mark && near.some(di => near.some(dj => this.row(i + di, j + dj) === -mark))) found.push([i, j]);
    }
    for (const [i, j] of found) this.writable((j >> 5) * across + (i >> 5)).by[(j & 31) * TILE + (i & 31)] = -mark;
  }
}
