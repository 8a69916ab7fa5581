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
    this.tiles = tiles;  // each {h: heights, by: the row that cut a cell + 1, negative where it was a rapid in material}
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
        tiles.push({h, by});
      }
    return new Heights(grid, tiles);
  }
  fork() {
    this.own.fill(0);
    return new Heights(this.grid, this.tiles.slice());
  }
  writable(k) {
    if (!this.own[k]) {
      const {h, by} = this.tiles[k];
      this.tiles[k] = {h: h.slice(), by: by.slice()};
      this.own[k] = 1;
    }
    this.touched.add(k);
    return this.tiles[k];
  }
  // The tiles that are not what was sent of them, and their neighbours, whose slopes change with them; `sent` is brought up
  // to date. A tile that was cut since stands there under the same name.
  changed(sent) {
    const {across} = this.grid, found = new Set();
    this.tiles.forEach((tile, k) => {
      if (sent[k] === tile && !this.touched.has(k)) return;
      sent[k] = tile;
      for (const up of [-across, 0, across])
        for (const side of [-1, 0, 1]) if (this.tiles[k + up + side]) found.add(k + up + side);
    });
    this.touched.clear();
    return found;
  }
  // How steeply the heights rise along X and Y, over three by three cells: so round walls of square cells look round.
  slope(i, j) {
    const {grid} = this, [w, e] = [Math.max(i - 1, 0), Math.min(i + 1, grid.nx - 1)], [s, n] = [Math.max(j - 1, 0), Math.min(j + 1, grid.ny - 1)];
    const height = (x, y) => this.tiles[(y >> 5) * grid.across + (x >> 5)].h[(y & 31) * TILE + (x & 31)];
    const sw = height(w, s), se = height(e, s), nw = height(w, n), ne = height(e, n), wide = 8 * grid.step;
    return [(se + 2 * height(e, j) + ne - sw - 2 * height(w, j) - nw) / wide, (nw + 2 * height(i, n) + ne - sw - 2 * height(i, s) - se) / wide];
  }
  at(i, j) {
    const {grid} = this, tile = this.tiles[(j / TILE | 0) * grid.across + (i / TILE | 0)], at = j % TILE * TILE + i % TILE;
    return {height: tile.h[at], by: tile.by[at]};
  }

  // Take a piece of a row away; `rapid` is the same piece with a thinner cutter where the row is a rapid, `before` the map
  // before the row. Returns how many cells were looked at.
  take(piece, row, rapid = null, before = this) {
    const {grid} = this, {box, left, span} = piece, {nx} = grid, mark = row + 1;
    const j0 = grid.first(1, box[1]), j1 = grid.last(1, box[3]);
    if (grid.first(0, box[0]) > grid.last(0, box[2])) return 0;
    let seen = 0;
    for (let j = j0; j <= j1; j++) {
      const y = grid.y(j), [from, to] = span(y), i0 = grid.first(0, from), i1 = grid.last(0, to);
      seen += Math.max(i1 - i0 + 1, 0) + 4;
      for (let i = i0; i <= i1;) {
        const ti = i / TILE | 0, k = (j / TILE | 0) * grid.across + ti, end = Math.min(i1, ti * TILE + TILE - 1);
        let tile = this.tiles[k], open = false;
        for (; i <= end; i++) {
          const at = j % TILE * TILE + i % TILE, now = tile.h[at], floor = grid.floor[j * nx + i];
          if (now <= floor || now <= piece.low) continue;
          const x = grid.x(i), height = Math.max(left(x, y), floor);
          if (!(height < now - SAME)) continue;
          const red = rapid && rapid.left(x, y) < before.tiles[k].h[at] - THIN;
          if (!open) [tile, open] = [this.writable(k), true];
          tile.h[at] = height;
          tile.by[at] = red || (rapid && tile.by[at] === -mark) ? -mark : mark;
        }
      }
    }
    return seen;
  }
}
