// A section of a lathe as columns: at places along z the pieces of r where material is, [low, high, low, high …]. At every z
// at which something has a corner there are two columns, just before and just behind it, so that a face is where two columns
// at one z differ. Between them edges are straight, but where two of them cross: even columns lie close enough for that.

const BEFORE = 2e-4;  // mm from a corner to the columns beside it
const MOST_COLUMNS = 3000, EVEN_COLUMNS = 800;
const JOINED = 5e-4;  // mm off a line, within which sides are one

class Columns {
  constructor(z) {
    const places = [...new Set(z.map(v => Math.round(v * 1e4)))].sort((a, b) => a - b);
    const step = Math.ceil(2 * places.length / MOST_COLUMNS);
    const [low, high] = [places[0] / 1e4, places[places.length - 1] / 1e4], even = Array.from({length: EVEN_COLUMNS}, (_, k) => low + (high - low) * (k + 0.5) / EVEN_COLUMNS);
    this.z = Float64Array.from([...even, ...places.filter((_, k) => k % step === 0 || k === places.length - 1).flatMap(v => [v / 1e4 - BEFORE, v / 1e4 + BEFORE])]).sort();
    this.pieces = Array(this.z.length).fill([]);
  }
  // At the columns that an outline {z, r} reaches: where it is crossed, upwards.
  crossed(rings) {
    const found = new Map();
    for (const {z, r} of rings)
      for (let k = 0, n = z.length; k < n; k++) {
        const [a, b] = [k, (k + 1) % n], [from, to] = z[a] < z[b] ? [a, b] : [b, a];
        for (let i = last(this.z, z[from]) + 1; i < this.z.length && this.z[i] <= z[to]; i++) {
          const at = r[from] + (this.z[i] - z[from]) / (z[to] - z[from]) * (r[to] - r[from]);
          if (found.has(i)) found.get(i).push(at); else found.set(i, [at]);
        }
      }
    found.forEach(list => list.sort((a, b) => a - b));
    return found;
  }
  fill(rings) {
    this.crossed(rings).forEach((list, i) => { this.pieces[i] = list.map(r => Math.max(r, 0)); });
    return this;
  }
  take(ring) {
    this.crossed([ring]).forEach((list, i) => { this.pieces[i] = without(this.pieces[i], list); });
  }
  copy() {
    return Object.assign(Object.create(Columns.prototype), {z: this.z, pieces: this.pieces.slice()});
  }
  // Those of some columns alone.
  only(keep) {
    return Object.assign(this.copy(), {pieces: this.pieces.map((piece, k) => keep(piece, this.z[k]) ? piece : [])});
  }
  // The sides [r, z, r, z] of what is turned, the way out on their right; `kind` says of a place (r, column) what it is.
  sides(kind) {
    const found = [], open = [], {z, pieces} = this;
    const add = (slot, side, [a, b]) => {  // a side that goes on from the one before in its slot is the same one
      const [r0, z0, r1, z1] = side, other = open[slot], what = kind(r0, a) === kind(r1, b) ? kind(r0, a) : 1;
      if (Math.abs(r0) < 1e-9 && Math.abs(r1) < 1e-9) return;
      if (other && other.kind === what && Math.hypot(other.to[0] - r0, other.to[1] - z0) < 1e-9) {
        const [fr, fz] = other.from, long = Math.hypot(r1 - fr, z1 - fz);
        if (Math.abs((r0 - fr) * (z1 - fz) - (z0 - fz) * (r1 - fr)) < JOINED * long && (r0 - fr) * (r1 - r0) + (z0 - fz) * (z1 - z0) >= 0) {
          other.to = [r1, z1];
          return;
        }
      }
      found.push(open[slot] = {slot, kind: what, from: [r0, z0], to: [r1, z1]});
    };
    for (let k = 0; k + 1 < z.length; k++) {
      const [a, b] = [pieces[k], pieces[k + 1]], middle = (z[k] + z[k + 1]) / 2;
      if (a.length === b.length && a.every((r, n) => n % 2 || (r < b[n + 1] && b[n] < a[n + 1])))
        a.forEach((r, n) => add(n, [r, z[k], b[n], z[k + 1]], [k, k + 1]));
      else {
        for (const [one, other, sense, at] of [[a, b, 1, k], [b, a, -1, k + 1]]) {
          const face = without(one, other);
          for (let n = 0; n < face.length; n += 2) {
            const side = sense > 0 ? [face[n + 1], middle, face[n], middle] : [face[n], middle, face[n + 1], middle];
            found.push({slot: 1, kind: Math.max(kind(face[n], at), kind(face[n + 1], at)), from: side.slice(0, 2), to: side.slice(2)});
          }
        }
        open.length = 0;
      }
    }
    return found.map(({slot, kind: what, from, to}) => ({kind: what, side: slot % 2 ? [...from, ...to] : [...to, ...from]}));
  }
  // Its area in the half plane at an angle about the axis, as triangles that look one way.
  flat(angle, sense, axis) {
    const found = [], {z, pieces} = this, [c, s] = [Math.cos(angle), Math.sin(angle)], way = [-s * sense, c * sense, 0];
    for (let k = 0; k + 1 < z.length; k++) {
      const [a, b] = [pieces[k], pieces[k + 1]];
      if (a.length !== b.length || z[k + 1] - z[k] < 1e-6) continue;
      for (let n = 0; n < a.length; n += 2)
        for (const [r, at] of [[a[n], k], [a[n + 1], k], [b[n + 1], k + 1], [a[n], k], [b[n + 1], k + 1], [b[n], k + 1]])
          found.push(axis + r * c, r * s, z[at], ...way);
    }
    return found;
  }
}

// Pieces of a line [low, high …] without others.
function without(pieces, others) {
  let left = pieces;
  for (let k = 0; k + 1 < others.length; k += 2) {
    const [from, to] = [others[k], others[k + 1]], next = [];
    for (let n = 0; n < left.length; n += 2) {
      const [low, high] = [left[n], left[n + 1]];
      if (Math.min(high, from) - low > 1e-6) next.push(low, Math.min(high, from));
      if (high - Math.max(low, to) > 1e-6) next.push(Math.max(low, to), high);
    }
    left = next;
  }
  return left;
}
