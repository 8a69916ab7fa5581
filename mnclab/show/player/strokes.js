// Paths as points on the way to pixels: arcs and the true course of loose rapids in short pieces, every point with its
// row and the class of the line that leads to it.

const NOTHING = 0, RAPIDS = 1, CUTS = 2, PROBINGS = 3;
const MOST = 400;  // pieces of one arc

class Strokes {
  constructor(path, chord, course = null, home = 0, probes = () => false) {
    this.path = path;
    const loose = new Map();
    if (course) for (const i of course.loose.keys()) (loose.get(course.row[i]) || loose.set(course.row[i], []).get(course.row[i])).push(i);
    const counts = new Int32Array(path.n);
    let total = 1;
    for (let row = 0; row < path.n; row++) {
      counts[row] = path.arc[row] >= 0 ? this.pieces(row, chord) : loose.has(row) ? 4 * loose.get(row).length : (path.bends.get(row) || []).length + 1;
      total += counts[row];
    }
    this.x = new Float64Array(total);
    this.y = new Float64Array(total);
    this.z = new Float64Array(total);
    this.kind = new Uint8Array(total);
    this.row = new Int32Array(total);
    this.after = new Int32Array(path.n + 1);  // the last point of the rows before one
    this.n = total;
    [this.x[0], this.y[0], this.z[0]] = path.vertex(0);
    for (let row = 0, at = 1; row < path.n; row++) {
      const kind = path.kind[row], count = counts[row];
      const drawn = row < home || kind > PROBE ? NOTHING : kind === RAPID ? RAPIDS : kind === PROBE || probes(row) ? PROBINGS : CUTS;
      if (path.arc[row] >= 0 || path.bends.has(row)) this.bend(row, at, count);
      else if (loose.has(row)) this.course(course, loose.get(row), at);
      const end = at + count - 1;
      this.x[end] = path.x[row + 1];
      this.y[end] = path.y[row + 1];
      this.z[end] = path.z[row + 1];
      this.kind.fill(drawn, at, end + 1);
      this.row.fill(row, at, end + 1);
      this.after[row + 1] = end;
      at += count;
    }
  }
  pieces(row, chord) {
    const radius = this.path.radius(row), step = 2 * Math.acos(Math.max(0, 1 - chord / Math.max(radius, chord)));
    return Math.min(MOST, Math.max(1, Math.ceil(Math.abs(this.path.sweep[this.path.arc[row]]) / step)));
  }
  bend(row, at, count) {
    for (let k = 1; k < count; k++) {
      const point = this.path.point(row, k / count);
      [this.x[at + k - 1], this.y[at + k - 1], this.z[at + k - 1]] = point;
    }
  }
  course(course, pieces, at) {
    for (const i of pieces)
      for (let k = 1; k <= 4; k++, at++) {
        const [p0, v0, p1, v1] = course.loose.get(i), T = course.t[i + 1] - course.t[i];
        [this.x[at], this.y[at], this.z[at]] = p0.map((p, axis) => Course.cubic(T * k / 4, T, p, v0[axis], p1[axis], v1[axis]));
      }
  }
  project(camera) {
    const {n, x, y, z} = this, [w, h] = camera.size, {right: r, up: u, target: t, zoom} = camera;
    const sx = this.sx || (this.sx = new Float32Array(n)), sy = this.sy || (this.sy = new Float32Array(n));
    const ox = w / 2 - zoom * (t[0] * r[0] + t[1] * r[1] + t[2] * r[2]);
    const oy = h / 2 + zoom * (t[0] * u[0] + t[1] * u[1] + t[2] * u[2]);
    const [r0, r1, r2] = r.map(v => v * zoom), [u0, u1, u2] = u.map(v => v * zoom);
    for (let i = 0; i < n; i++) {
      sx[i] = ox + x[i] * r0 + y[i] * r1 + z[i] * r2;
      sy[i] = oy - x[i] * u0 - y[i] * u1 - z[i] * u2;
    }
  }
  // Lines of one class between two points, and of one shade where `of` says which a row has; steps below half a pixel are
  // passed over.
  stroke(pen, kind, from, to, of = null, shade = 0) {
    const {sx, sy, kind: kinds, row: rows} = this;
    let open = false, count = 0, lx = 0, ly = 0;
    pen.beginPath();
    for (let i = from + 1; i <= to; i++) {
      if (kinds[i] !== kind || (of && of[rows[i]] !== shade)) {
        open = false;
        continue;
      }
      if (!open) {
        pen.moveTo(lx = sx[i - 1], ly = sy[i - 1]);
        open = true;
      }
      const dx = sx[i] - lx, dy = sy[i] - ly;
      if (dx * dx + dy * dy < 0.3 && i < to && kinds[i + 1] === kind && (!of || of[rows[i + 1]] === shade)) continue;
      pen.lineTo(lx = sx[i], ly = sy[i]);
      if (++count % 200 === 0) {  // long paths cost more than many short ones
        pen.stroke();
        pen.beginPath();
        pen.moveTo(lx, ly);
      }
    }
    pen.stroke();
  }
  // From where to where the lines of some classes lie along a direction; from infinity where there are none.
  reach([dx, dy, dz], kinds) {
    const {x, y, z, kind} = this, chosen = [NOTHING, RAPIDS, CUTS, PROBINGS].map(each => kinds.includes(each));
    let low = Infinity, high = -Infinity;
    for (let i = 1; i < this.n; i++) {
      if (!chosen[kind[i]]) continue;
      const a = dx * x[i - 1] + dy * y[i - 1] + dz * z[i - 1], b = dx * x[i] + dy * y[i] + dz * z[i];
      low = Math.min(low, a, b);
      high = Math.max(high, a, b);
    }
    return [low, high];
  }
  // The smallest and greatest coordinates of some classes; null if they are empty.
  box(...kinds) {
    const spans = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(d => this.reach(d, kinds));
    return spans[0][0] <= spans[0][1] ? [0, 1].map(k => spans.map(span => span[k])) : null;
  }
  // The row of the line nearest to a place on the screen, within some pixels; of equal ones the one nearest to the eye.
  pick(x, y, camera, within, rapids) {
    const {sx, sy, kind} = this, near = camera.near;
    let best = -1, least = within, depth = -Infinity;
    for (let i = 1; i < this.n; i++) {
      if (kind[i] === NOTHING || (kind[i] === RAPIDS && !rapids)) continue;
      const ax = sx[i - 1], ay = sy[i - 1], dx = sx[i] - ax, dy = sy[i] - ay, length = dx * dx + dy * dy;
      const u = length > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length)) : 1;
      const away = Math.hypot(ax + u * dx - x, ay + u * dy - y);
      if (away > least + 1 || away > within) continue;
      const here = this.x[i] * near[0] + this.y[i] * near[1] + this.z[i] * near[2];
      if (away < least - 1 || here > depth + 1e-6) {
        best = this.row[i];
        least = Math.min(least, away);
        depth = here;
      }
    }
    return best;
  }
}
