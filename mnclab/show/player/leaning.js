// What a tilted tool leaves of the upright columns of the map, along a straight piece of a move. Seen along itself it is upright (see
// swept.js), and with all that stands above it a convex body, so that a column has one gap; the column falls to the lower end of the
// gap where the gap is open at its top.

const SEARCHED = 24;  // times a gap is narrowed, and halved, where the lower side of the tool is not level

// From where to where a straight line q + s e is within a radius of a stretch from a to b, all in a plane; null if it never is.
function within(radius, [ax, ay], [bx, by], [qx, qy], [ex, ey]) {
  const fast = Math.hypot(ex, ey), [ux, uy] = fast > STILL ? [ex / fast, ey / fast] : [1, 0];
  let begin = Infinity, end = -Infinity;
  const add = (from, to) => { if (from <= to) [begin, end] = [Math.min(begin, from), Math.max(end, to)]; };
  for (const [x, y] of [[qx - ax, qy - ay], [qx - bx, qy - by]]) {
    const ahead = x * ux + y * uy, rest = radius * radius - x * x - y * y + (fast > STILL ? ahead * ahead : 0);
    if (rest >= 0) add(...fast > STILL ? [-ahead - Math.sqrt(rest), Math.sqrt(rest) - ahead] : [-Infinity, Infinity]);
  }
  const dx = bx - ax, dy = by - ay, length = Math.hypot(dx, dy);
  if (length > STILL) {
    let from = -Infinity, to = Infinity;
    for (const [wx, wy, low, high] of [[dx / length, dy / length, 0, length], [-dy / length, dx / length, -radius, radius]]) {
      const at = (qx - ax) * wx + (qy - ay) * wy, rate = fast > STILL ? ux * wx + uy * wy : 0;
      if (Math.abs(rate) < STILL) { if (at < low || at > high) to = -Infinity; continue; }
      const [one, other] = [(low - at) / rate, (high - at) / rate];
      [from, to] = [Math.max(from, Math.min(one, other)), Math.min(to, Math.max(one, other))];
    }
    add(from, to);
  }
  return begin <= end ? fast > STILL ? [begin / fast, end / fast] : [begin, end] : null;
}

// Like a straight piece, of a cutter that stands along a direction of the part; `top` is as high as there is material.
function leaningPiece(cutter, a, b, up, top) {
  const radius = cutter[0], [x, y, z] = up, share = z < -0.999999 ? 0 : 1 / (1 + z);
  const ways = z < -0.999999 ? [[1, 0, 0], [0, -1, 0], [0, 0, -1]] : [[1 - x * x * share, -x * y * share, -x], [-x * y * share, 1 - y * y * share, -y], up];
  const seen = p => ways.map(way => way[0] * p[0] + way[1] * p[1] + way[2] * p[2]), [one, other] = [seen(a), seen(b)], e = seen([0, 0, 1]);
  const piece = straightPiece(cutter, one, other), plain = cutter[1] >= radius && (Math.abs(one[2] - other[2]) < STILL || Math.hypot(other[0] - one[0], other[1] - one[1]) <= STILL);
  const rim = radius * Math.sqrt(Math.max(1 - z * z, 0)), long = Math.min((top - Math.min(a[2], b[2]) + rim) / Math.max(Math.abs(z), 0.01), 1e4);
  const ends = [a, b].flatMap(p => [p, p.map((v, k) => v + Math.max(long, 0) * up[k])]), reach = [0, 1].map(k => ends.map(p => p[k]));
  const box = [...reach.map(all => Math.min(...all) - radius), ...reach.map(all => Math.max(...all) + radius)];
  const free = (q, s) => q[2] + s * e[2] - piece.left(q[0] + s * e[0], q[1] + s * e[1]);  // above the edge, inside
  const gap = (px, py) => {  // from where to where a column is taken; null where it is not
    const q = seen([px, py, 0]), found = within(radius * (1 + 1e-12), one, other, q, e);
    if (!found) return null;
    let [begin, end] = found;
    if (plain) {
      const at = (piece.low - q[2]) / e[2];
      if (Math.abs(e[2]) < STILL) { if (q[2] < piece.low) return null; } else if (e[2] > 0) begin = Math.max(begin, at); else end = Math.min(end, at);
      return begin < end ? [begin, end] : null;
    }
    if (!Number.isFinite(begin)) [begin, end] = [-1e4, 1e4];  // along the column
    let low = begin, high = end;
    for (let k = 0; k < SEARCHED; k++) {  // the place that is deepest in the tool
      const third = (high - low) / 3;
      if (free(q, low + third) > free(q, high - third)) high -= third; else low += third;
    }
    const middle = (low + high) / 2;
    if (!(free(q, middle) >= 0)) return null;
    return [begin, end].map(outside => {
      let inside = middle;
      for (let k = 0; k < SEARCHED; k++) {
        const half = (inside + outside) / 2;
        if (free(q, half) >= 0) inside = half; else outside = half;
      }
      return inside;
    });
  };
  const low = Math.min(a[2], b[2]) - rim, left = (px, py, now = top) => {
    const found = gap(px, py);
    return found && found[1] >= Math.min(now, top) - SAME ? found[0] : Infinity;
  };
  return {box, low, left, span: () => [box[0], box[2]]};
}
