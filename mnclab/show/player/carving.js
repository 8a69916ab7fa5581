// The part at any place of the run: rows are cut one after the other from the nearest key frame on, in slices of time, so
// that the page never waits. Key frames are maps that share what did not change between them.

const NO_CUT = 0, CUT = 1, ARRIVAL = 2;  // what a row does to the part (see part.py)
const WORK = 400_000;  // cells looked at between two key frames: some milliseconds of work
const MOST_PLACES = 24;  // of a row, at which its engagement is looked for
const CHORD = 0.002;  // mm that the chord of an arc may lie off it
const HELD = 3_000;  // tiles that all key frames may hold together, each 16 KiB

class Carving {
  constructor(run) {
    const {part, columns} = run.header, floor = columns[part.floor].map(v => v / part.parts);
    this.run = run;
    this.grid = new Grid(part, floor);
    this.cutters = part.cutters;
    [this.which, this.does, this.lift] = ["which", "does", "lift"].map(name => new Log(columns, part[name]));
    this.along = part.along && new Log(columns, part.along);  // of tools that do not stand along Z
    const blank = Heights.of(this.grid, columns[part.top].map(v => v / part.parts));
    if (part.walls !== undefined) blank.stand(columns[part.walls], columns[part.shares]);
    if (part.round) {  // the walls of a standing cylinder
      const [x, y, radius, bore] = part.round, {low, high} = part, left = (a, b) => {
        const out = Math.hypot(a - x, b - y);
        return out > radius || out < bore ? -Infinity : Infinity;
      };
      blank.wall({box: [...low, ...high], low: -Infinity, left, span: () => [low[0], high[0]]});
    }
    this.depths = [floor.reduce((a, b) => Math.min(a, b), Infinity), blank.tiles.reduce((a, {h}) => h.reduce((b, v) => Math.max(b, v), a), -Infinity)];
    this.apart = WORK;
    this.held = 0;
    this.frames = [{rows: 0, map: blank}];
    this.live = this.from(this.frames[0]);
    this.scout = this.from(this.frames[0]);
    this.engaged = new Float32Array(run.path.n);  // degrees, the greatest of each row that the scout has cut
    this.target = {rows: 0, share: 0};
  }
  from({rows, map}) {
    return {rows, share: 0, map: map.fork(), begin: null, spent: 0};
  }
  get map() {
    return this.live.map;
  }
  get there() {
    return this.live.rows === this.target.rows && this.live.share === this.target.share;
  }
  get scouted() {
    return this.scout.rows >= this.run.path.n;
  }

  // Where the part shall stand: so many rows done, and a share of the next one.
  aim(rows, share) {
    this.target = rows < this.run.path.n ? {rows, share} : {rows, share: 0};
  }
  // Go there until a time of the clock (ms); true once there.
  work(until) {
    const {target} = this;
    let {live} = this;
    if (target.rows === live.rows && target.share < live.share) {
      live = this.live = {...live, share: 0, map: live.begin.fork()};
    } else if (target.rows !== live.rows) {
      const frame = this.frames[this.frameBefore(target.rows)];
      if (target.rows < live.rows || frame.rows > live.rows) live = this.live = this.from(frame);
    }
    if (!this.on(live, target.rows, until)) return false;
    if (target.share > live.share) {
      if (live.share === 0) live.begin = live.map.fork();
      this.cut(live, target.share);
    }
    return true;
  }
  // Cut ahead, so that there are key frames wherever one may want to go.
  ahead(until) {
    return this.on(this.scout, this.run.path.n, until);
  }
  frameBefore(rows) {
    let low = 0, high = this.frames.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.frames[middle].rows <= rows) low = middle + 1; else high = middle;
    }
    return low - 1;
  }

  on(state, rows, until) {
    for (let k = 0; state.rows < rows; k++) {
      if ((k & 7) === 7 && performance.now() > until) return false;
      this.cut(state, 1);
      state.rows++;
      state.share = 0;
      state.begin = null;
      if (state.spent > this.apart) this.keep(state);
    }
    return true;
  }
  keep(state) {
    const latest = this.frames[this.frames.length - 1];
    state.spent = 0;
    if (state.rows <= latest.rows) return;
    const frame = {rows: state.rows, map: state.map.fork()};
    this.held += changed(latest.map, frame.map);
    this.frames.push(frame);
    if (this.held < HELD) return;
    this.frames = this.frames.filter((_, k) => k % 2 === 0);  // half as many, twice as far apart
    this.apart *= 2;
    this.held = this.frames.reduce((sum, {map}, k) => sum + (k ? changed(this.frames[k - 1].map, map) : 0), 0);
  }
  // The row that a state stands in, from the share done to another one.
  cut(state, share) {
    const {rows: row, map} = state, {path} = this.run, does = this.does.value(row);
    if (does !== NO_CUT && (does === CUT || share === 1)) {
      const cutter = this.cutters[this.which.value(row)], rapid = path.kind[row] === RAPID;
      if (state === this.scout && does === CUT && !rapid && !(this.along && this.along.value(row))) this.engaged[row] = this.engagement(cutter, row, map);
      const thin = [Math.max(cutter[0] - THIN, 0), Math.min(cutter[1], Math.max(cutter[0] - THIN, 0)), cutter[2], cutter[3]];
      for (const make of this.pieces(row, does === ARRIVAL ? 1 : state.share, share))
        state.spent += map.take(make(cutter), row, rapid ? make(thin) : null, state.begin || map);
    }
    state.spent += 20;
    state.share = share;
  }
  // The part of the front half of the rim, degrees, that has material before it, at the place of a row where that is most. What
  // counts is the material beside the foot of the tool, above its lower side there; straight down there is no front.
  engagement(cutter, row, map) {
    const {path} = this.run, lift = this.lift.value(row), rim = cutter[0], foot = edgeHeight(cutter, rim * rim) + lift + 2 * THIN;
    const places = Math.min(Math.max(2, Math.ceil(2 * path.length(row) / rim)), MOST_PLACES);
    let most = 0;
    for (let k = 0; k < places; k++) {
      const share = (k + 0.5) / places, [x, y, z] = path.point(row, share), [fx, fy] = path.point(row, share + 1e-4);
      if (Math.hypot(fx - x, fy - y) < 1e-9) return 0;
      const ahead = Math.atan2(fy - y, fx - x);
      let met = 0;
      for (let n = 0; n < 60; n++) {
        const angle = ahead + (n - 29.5) * Math.PI / 60;
        met += map.over(x + rim * Math.cos(angle), y + rim * Math.sin(angle)) > z + foot;
      }
      most = Math.max(most, 3 * met);
    }
    return most;
  }
  // What a row is between two shares of it: functions that make a piece for a cutter. Arcs about Z at one height stay arcs.
  pieces(row, from, to) {
    const {path} = this.run, lift = this.lift.value(row), k = path.arc[row];
    const point = share => path.point(row, share).map((value, axis) => axis === 2 ? value + lift : value), up = this.along && this.along.value(row);
    const straight = up ? (a, b) => cutter => leaningPiece(cutter, a, b, up, this.depths[1]) : (a, b) => cutter => straightPiece(cutter, a, b);
    if (k < 0 || from === to) {
      return [straight(point(from), point(to))];
    }
    const a = path.vertex(row), b = path.vertex(row + 1), c = path.centre.map(column => column[k]), upright = path.axis.value(k)[2];
    const [one, other] = [a, b].map(end => Math.hypot(end[0] - c[0], end[1] - c[1]));
    if (!up && Math.abs(upright) > 1 - 1e-9 && a[2] === b[2] && Math.abs(one - other) < this.grid.step / 50) {
      const turn = path.sweep[k] * Math.sign(upright), first = Math.atan2(a[1] - c[1], a[0] - c[0]) + from * turn;
      return [cutter => arcPiece(cutter, c, one, first, (to - from) * turn, a[2] + lift)];
    }
    const radius = path.radius(row), bend = 2 * Math.acos(Math.max(0, 1 - CHORD / Math.max(radius, CHORD)));
    const count = Math.max(1, Math.ceil(Math.abs(path.sweep[k]) * (to - from) / bend)), places = [];
    for (let i = 0; i <= count; i++) places.push(point(from + (to - from) * i / count));
    return places.slice(1).map((end, i) => straight(places[i], end));
  }
}

// How many tiles of two maps are not the same.
function changed(map, other) {
  return map.tiles.reduce((count, tile, k) => count + (tile !== other.tiles[k]), 0);
}
