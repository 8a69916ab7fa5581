// The run, unpacked (see packing.py and payload.py): columns, the course of its steps, the tool at any time.

const RAPID = 0, LINE = 1, ARC = 2, PROBE = 3, DWELL = 4, TOOL = 5, SPINDLE = 6, COOLANT = 7, STOP = 8;
const KINDS = ["rapid", "line", "arc", "probing", "dwell", "tool", "spindle", "coolant", "stop"];

const TOLD = 2 ** 49;  // parts, that a number of the text may tell at most

function unpack(bytes) {
  const size = new DataView(bytes.buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + size)));
  let at = 4 + size;
  header.columns = header.columns.map(n => {
    const column = new Float64Array(n);  // whole numbers: exact to 2^53
    for (let i = 0, before = 0; i < n; i++) {
      let byte = bytes[at++], value = byte & 127;
      for (let place = 128; byte > 127; place *= 128) {
        byte = bytes[at++];
        value += (byte & 127) * place;
      }
      column[i] = before += value % 2 ? -(value + 1) / 2 : value / 2;
    }
    return column;
  });
  return header;
}

// The greatest index whose value is not above x; -1 if there is none.
function last(sorted, x) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= x) low = middle + 1; else high = middle;
  }
  return low - 1;
}

class Log {  // places where a value changes, and the values from there on
  constructor(columns, {at, of, values}) {
    this.at = columns[at];
    this.of = columns[of];
    this.values = values;
  }
  value(i) {
    const k = last(this.at, i);
    return k < 0 ? undefined : this.values[this.of[k]];
  }
  changedAt(i) {
    const k = last(this.at, i);
    return k >= 0 && this.at[k] === i;
  }
}

// An element of the page with its properties and what is within.
function made(tag, properties, ...within) {
  const found = Object.assign(document.createElement(tag), properties);
  found.append(...within);
  return found;
}

// A vector about a unit vector n by an angle, right-handed.
function turned(v, n, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)], along = (1 - c) * v.reduce((sum, value, i) => sum + value * n[i], 0);
  return v.map((value, i) => c * value + s * (n[(i + 1) % 3] * v[(i + 2) % 3] - n[(i + 2) % 3] * v[(i + 1) % 3]) + along * n[i]);
}

class Path {  // kinds, vertices and arcs; positions in mm
  constructor(columns, packed, scale, angles, bent = null) {
    this.kind = Uint8Array.from(columns[packed.kind]);
    this.n = this.kind.length;
    [this.x, this.y, this.z] = packed.vertex.map(k => columns[k].map(v => v / scale));
    this.centre = packed.centre.map(k => columns[k].map(v => v / scale));
    this.sweep = columns[packed.sweep].map(v => v / angles);
    this.axis = new Log(columns, packed.axis);
    this.bends = new Map();  // of rapids that turn the workpiece: the places between their ends
    if (bent) columns[bent.row].forEach((row, k) => {
      if (!this.bends.has(row)) this.bends.set(row, []);
      this.bends.get(row).push(bent.at.map(id => columns[id][k] / scale));
    });
    this.arc = new Int32Array(this.n);  // which arc a row is
    for (let i = 0, k = 0; i < this.n; i++) this.arc[i] = this.kind[i] === ARC ? k++ : -1;
  }
  vertex(k) {
    return [this.x[k], this.y[k], this.z[k]];
  }
  isMotion(row) {
    return this.kind[row] <= PROBE;
  }
  // The point of a row at a share of its way. What an arc misses of its end is spread along it, like the pitch.
  point(row, share) {
    const bends = this.bends.get(row);
    if (bends) {
      const all = [this.vertex(row), ...bends, this.vertex(row + 1)], at = Math.min(Math.max(share, 0), 1) * (all.length - 1);
      const i = Math.min(Math.floor(at), all.length - 2);
      return all[i].map((v, axis) => v + (at - i) * (all[i + 1][axis] - v));
    }
    const a = this.vertex(row), b = this.vertex(row + 1), k = this.arc[row];
    if (k < 0) return a.map((start, i) => start + share * (b[i] - start));
    const n = this.axis.value(k), c = this.centre.map(column => column[k]);
    let u = a.map((start, i) => start - c[i]);
    const along = u[0] * n[0] + u[1] * n[1] + u[2] * n[2];
    u = u.map((value, i) => value - along * n[i]);
    const here = turned(u, n, this.sweep[k] * share), full = turned(u, n, this.sweep[k]);
    return a.map((start, i) => start - u[i] + here[i] + share * (b[i] - (start - u[i] + full[i])));
  }
  length(row) {
    const arc = this.arc[row], end = this.vertex(row + 1), way = this.vertex(row).map((v, k) => end[k] - v);
    if (arc < 0) return Math.hypot(...way);
    const rises = this.axis.value(arc).reduce((sum, n, k) => sum + n * way[k], 0);
    return Math.hypot(this.radius(row) * this.sweep[arc], rises);
  }
  radius(row) {
    const k = this.arc[row], n = this.axis.value(k);
    const u = this.vertex(row).map((start, i) => start - this.centre[i][k]);
    const along = u[0] * n[0] + u[1] * n[1] + u[2] * n[2];
    return Math.hypot(...u.map((value, i) => value - along * n[i]));
  }
}

class Course {  // nodes of the feed-rate profile: when, how fast, and where in a row
  constructor(columns, packed, scale, turning, path) {
    this.row = columns[packed.row];
    this.v = columns[packed.v].map(v => v / packed.speeds);  // mm/s
    this.n = this.row.length;
    this.t = (packed.guessed ? this.timed(columns[packed.t], packed.seconds, path) : columns[packed.t]).map(v => v / packed.seconds);
    this.way = new Float64Array(this.n);
    const s = packed.s === undefined ? null : columns[packed.s];
    for (let i = 0; i < this.n; i++)
      this.way[i] = s ? (s[i + 1] - s[i]) / scale : (this.v[i] + this.v[i + 1]) / 2 * (this.t[i + 1] - this.t[i]);
    this.done = new Float64Array(this.n);  // length of the row before a piece
    const rows = this.n ? this.row[this.n - 1] + 1 : 0;
    this.length = new Float64Array(rows);  // of rows, and their duration
    this.seconds = new Float64Array(rows);
    for (let i = 0; i < this.n; i++) {
      const same = i > 0 && this.row[i - 1] === this.row[i];
      this.done[i] = same ? this.done[i - 1] + this.way[i - 1] : 0;
      this.length[this.row[i]] = this.done[i] + this.way[i];
      this.seconds[this.row[i]] += this.t[i + 1] - this.t[i];
    }
    this.loose = new Map();  // pieces of rapids that leave their straight line
    if (packed.loose && !turning) {
      const {piece, p0, p1, v0, v1} = packed.loose;
      const at = (ids, k, parts) => ids.map(id => columns[id][k] / parts);
      columns[piece].forEach((i, k) =>
        this.loose.set(i, [at(p0, k, scale), at(v0, k, packed.speeds), at(p1, k, scale), at(v1, k, packed.speeds)]));
    }
  }
  // Times of which only what was not guessed is sent (see payload.py).
  timed(sent, seconds, path) {
    const {row, v, n} = this, t = sent.slice(), whole = value => Math.abs(value) < TOLD ? Math.floor(value + 0.5) : 0;
    let before = 0;
    for (let i = 0, end; i < n; i = end) {
      for (end = i + 1; end < n && row[end] === row[i];) end++;
      const d = [0, 1, 2].map(k => sent[i + k + 1] - sent[i + k]), speed = k => (v[i + k] + v[i + k + 1]) / 2;
      const guessed = end - i === 3 && path.arc[row[i]] < 0;
      if (guessed) {
        before = d[0] += before;
        d[2] += whole(d[0] * (Math.abs(v[i + 3] - v[i + 2]) / Math.abs(v[i + 1] - v[i])));
        d[1] += whole((path.length(row[i]) - (speed(0) * (d[0] / seconds) + speed(2) * (d[2] / seconds))) / speed(1) * seconds);
      }
      for (let k = i; k < end; k++) t[k + 1] = t[k] + (guessed ? d[k - i] : sent[k + 1] - sent[k]);
    }
    return t;
  }
  get time() {
    return this.n ? this.t[this.n] : 0;
  }
  // Between two nodes the way is a cubic with the speeds at both: exact for constant acceleration and constant jerk.
  static cubic(t, T, p0, v0, p1, v1) {
    const u = T > 0 ? t / T : 1, w = 1 - u;
    return w * w * (1 + 2 * u) * p0 + u * w * w * T * v0 + u * u * (3 - 2 * u) * p1 - u * u * w * T * v1;
  }
}

class Recorded {  // the whole run; an *item* is a row of the path, or a step that made none
  constructor(header) {
    const {columns, scale} = header;
    this.header = header;
    this.lathe = header.lathe;
    this.unit = header.unit;  // in what the program counts: its name, how many mm it has, decimals of a position
    this.origin = header.origin;
    this.texts = header.programs.map(program => program.text.replace(/\r\n?/g, "\n").split("\n"));
    this.lines = header.lines.map(k => columns[k]);
    this.block = columns[header.steps.block];
    this.program = columns[header.steps.program];
    this.rowStep = columns[header.row.step];
    this.tell(header.path);
    this.path = new Path(columns, header.path, scale, header.angles, header.bent);
    this.programmed = header.programmed && new Path(columns, header.programmed, scale, header.angles);
    this.course = new Course(columns, header.profile, scale, header.turning, this.path);
    this.lasts = header.lasts.map((k, p) => columns[k].map((more, b) => this.lines[p][b] + more));
    this.steps = this.block.length;
    this.row = {};
    for (const [name, log] of Object.entries(header.row)) if (name !== "step") this.row[name] = new Log(columns, log);
    this.history = new Map(Object.entries(header.history).map(([name, log]) => [name, new Log(columns, log)]));
    this.positions = {at: columns[header.position.at], from: header.position.from.map(k => columns[k])};
    this.scale = scale;
    this.rotary = header.rotary && header.rotary.map(k => columns[k].map(v => v / header.degrees));
    this.turned = this.rotary ? this.rotary.map(column => column.some(angle => angle !== 0)) : [];
    this.chain = header.machine && new Chain(columns, header.machine);
    this.stock = header.stock;
    this.inserts = header.inserts && {which: new Log(columns, header.inserts.which), tools: header.inserts.tools};
    this.loose = new Set([...this.course.loose.keys()].map(piece => this.course.row[piece]));  // rapids that leave their straight line
    this.arrange();
  }

  // The ends of rows, sent as what differs from what their blocks say, or else from the end before (see payload.py).
  tell({vertex, told}) {
    const {header: {columns, scale}, unit, rowStep} = this;
    vertex.filter((_, axis) => told[axis]).forEach(id => {
      const column = columns[id], number = new RegExp("XYZ"[vertex.indexOf(id)] + "([-+]?[0-9]*[.]?[0-9]+)");
      for (let k = 1; k < column.length; k++) {
        const step = rowStep[k - 1], said = number.exec(this.texts[this.program[step]][this.lineOf(step) - 1] || "");
        const value = said ? said[1] * unit.length * scale + 0.5 : Infinity;
        column[k] += Math.abs(value) < TOLD ? Math.floor(value) : column[k - 1];
      }
    });
  }

  arrange() {
    const {path, course} = this, row = [], step = [], begin = [], end = [];
    const first = new Int32Array(this.steps + 1);
    let piece = 0, now = 0;
    for (let s = 0, r = 0; s < this.steps; s++) {
      first[s] = row.length;
      do {
        const own = r < path.n && this.rowStep[r] <= s;
        step.push(s);
        begin.push(now);
        if (own) {
          while (piece < course.n && course.row[piece] === r) piece++;
          now = piece > 0 && course.row[piece - 1] === r ? course.t[piece] : now;
        }
        row.push(own ? r++ : -1);
        end.push(now);
      } while (r < path.n && this.rowStep[r] <= s);
    }
    first[this.steps] = row.length;
    this.itemRow = Int32Array.from(row);
    this.itemStep = Int32Array.from(step);
    this.begin = Float64Array.from(begin);
    this.end = Float64Array.from(end);
    this.first = first;
    this.items = row.length;
    this.before = new Int32Array(this.items);  // rows done before an item
    this.itemOfRow = new Int32Array(path.n);
    for (let i = 0, done = 0; i < this.items; i++) {
      this.before[i] = done;
      if (row[i] >= 0) this.itemOfRow[done++] = i;
    }
  }

  probes(row) {  // with a probe in the spindle, which cuts nothing at feed either
    return /probe/i.test(this.history.get("tool")?.value(this.rowStep[row])?.kind);
  }
  get time() {
    return this.items ? this.end[this.items - 1] : 0;
  }
  rowsDone(item, whole) {
    return this.items ? this.before[item] + (whole && this.itemRow[item] >= 0 ? 1 : 0) : 0;
  }
  pieceAt(row, t) {
    const {course} = this;
    let i = Math.min(last(course.t, t), course.n - 1);
    while (i > 0 && course.row[i] > row) i--;
    while (i + 1 < course.n && course.row[i] < row) i++;
    return course.row[i] === row ? i : -1;
  }
  // The tool during an item: its place (mm) and speed (mm/s).
  tool(item, t) {
    const row = this.items ? this.itemRow[item] : -1, {path, course} = this;
    if (row < 0) return {point: path.vertex(this.items ? this.before[item] : 0), speed: 0, share: 1};
    if (t >= this.end[item]) return {point: path.vertex(row + 1), speed: t > this.begin[item] ? this.speedAfter(row) : 0, share: 1};
    const i = this.pieceAt(row, t);
    const passed = (t - this.begin[item]) / (this.end[item] - this.begin[item]);
    if (!path.isMotion(row) || i < 0) return {point: path.isMotion(row) ? path.point(row, passed) : path.vertex(row), speed: 0, share: passed};
    const T = course.t[i + 1] - course.t[i], since = Math.min(Math.max(t - course.t[i], 0), T);
    const way = Course.cubic(since, T, 0, course.v[i], course.way[i], course.v[i + 1]);
    const u = since / T, w = 1 - u;
    const speed = this.over(row, 6 * u * w * course.way[i] / T + w * (1 - 3 * u) * course.v[i] + u * (3 * u - 2) * course.v[i + 1]);
    const loose = course.loose.get(i), length = course.length[row], share = length > 0 ? (course.done[i] + way) / length : passed;
    if (loose) {
      const [p0, v0, p1, v1] = loose;
      return {point: p0.map((p, k) => Course.cubic(since, T, p, v0[k], p1[k], v1[k])), speed: Math.max(speed, 0), share};
    }
    return {point: path.point(row, share), speed: Math.max(speed, 0), share};
  }
  // How fast the tool cuts along a workpiece that turns, where its linear axes run at `speed`; where these stand, the mean.
  over(row, speed) {
    const {path, course} = this, kind = path.kind[row];
    if (!this.header.turning || (kind !== LINE && kind !== ARC)) return speed;
    const own = course.length[row], seconds = course.seconds[row];
    return own > 1e-6 ? speed * path.length(row) / own : seconds > 0 ? path.length(row) / seconds : speed;
  }
  // Rotary axes A, B and C at a share of a row, degrees; null in a run that turns none.
  angles(row, share) {
    const first = k => this.chain ? this.chain.home[k] : 0;
    return this.rotary && this.rotary.map((angle, k) => {
      const before = row > 0 ? angle[row - 1] : first(k);
      return row < 0 ? first(k) : before + share * (angle[row] - before);
    });
  }
  // A tip in machine coordinates, or where rotary axes swing it the spindle reference, at angles of these in a row and with a
  // tool of a length.
  reference(tip, angles, row, length) {
    const at = this.chain ? this.chain.in(row).reference(tip, angles, length) : tip;
    return at.map((value, k) => value + this.origin[k]);
  }
  // The spindle speed; at constant cutting speed it follows X, but not beyond its limit.
  turning(row, point) {
    const {row: columns} = this, told = columns.spindle.value(row) || 0, surface = columns.surface.value(row), limit = columns.speed_limit.value(row);
    if (typeof surface !== "number" || !told) return told;
    const speed = 1000 * surface / (2 * Math.PI * Math.abs(point[0] - columns.spindle_x.value(row)));
    return Math.sign(told) * Math.min(speed, typeof limit === "number" ? limit : Infinity);
  }
  // The feed, which at constant cutting speed follows the spindle where it is one per revolution.
  feed(row, point) {
    const {surface, per_rev, feed} = this.row, per = per_rev.value(row);
    return typeof surface.value(row) === "number" && typeof per === "number" ? per * Math.abs(this.turning(row, point)) : feed.value(row);
  }
  speedAfter(row) {
    const i = last(this.course.row, row);
    return i >= 0 && this.course.row[i] === row ? this.over(row, this.course.v[i + 1]) : 0;
  }
  // The item that is going on at a time; of several that take no time the last.
  itemAt(t) {
    return Math.max(last(this.begin, t), 0);
  }
  lineOf(step) {
    return this.lines[this.program[step]][this.block[step]];
  }
  // The programmed point after a step, mm, in the coordinates of the program.
  position(step) {
    const {at, from} = this.positions, k = last(at, step);
    if (k < 0) return null;
    const {x, y, z} = this.path, vertex = this.path.n ? last(this.rowStep, at[k]) + 1 : 0;
    const tip = this.path.n ? [x[vertex], y[vertex], z[vertex]] : [0, 0, 0];
    return from.map((column, i) => (Math.round(tip[i] * this.scale) + column[k]) / this.scale);
  }
  // Everything that has a value after a step, as run.at(step=...).state says it.
  state(step) {
    const found = {position: this.position(step)};
    for (const [name, log] of this.history) {
      const value = log.value(step);
      if (value !== undefined && value !== null) found[name] = value;
    }
    return found;
  }
  changed(step) {
    return [...this.history].filter(([, log]) => log.changedAt(step)).map(([name]) => name);
  }
  // The step at which a block is executed next, beginning after a step and starting over; -1 if it never is.
  execution(program, block, after) {
    for (let k = 1; k <= this.steps; k++) {
      const step = (after + k + this.steps) % this.steps;
      if (this.block[step] === block && this.program[step] === program) return step;
    }
    return -1;
  }
  blockOfLine(program, line) {
    return last(this.lines[program], line);
  }
}
