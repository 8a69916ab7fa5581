// Lines {x, y, ux, uy} without ends and circles {x, y, r} in a plane, and which places on them a pointer means.

const CORNER = 0, POINT = 2, MIDDLE = 3, EDGE = 5, WALL = 8, FREE = 12;  // pixels that a place may be nearer for it

const LOOKED = 24, PAIRED = 8;  // curves about a place that are looked at, and that may end at a corner with others

// The places nearest to another one on curves where `told` knows an edge, and the corners where two of them end there.
function snaps(curves, [x, y], reach, along, told) {
  const away = ([px, py]) => Math.hypot(px - x, py - y), corners = [];
  const near = curves.map(curve => ({curve, place: footOn(curve, x, y)})).filter(({place}) => away(place) <= reach)
    .sort((a, b) => away(a.place) - away(b.place)).slice(0, LOOKED).map(each => ({...each, told: told(each.curve, each.place)}));
  const edges = near.filter(each => each.told), some = [...edges, ...near.filter(each => !each.told)].slice(0, PAIRED);
  edges.slice(0, PAIRED).forEach(({curve: one}, k) => some.slice(k + 1).forEach(({curve: other}) => {
    for (const place of crossings(one, other).filter(place => away(place) <= reach)) {
      const both = [one, other].map(curve => [-along, along].map(s => told(curve, moved(curve, place, s))).find(Boolean));
      if (both[0] && both[1]) corners.push({place, told: both});
    }
  }));
  return {edges, corners};
}

function footOn({x, y, r, ux, uy}, px, py) {  // the nearest place
  const along = r ? r / (Math.hypot(px - x, py - y) || 1) : (px - x) * ux + (py - y) * uy;
  return r ? [x + along * (px - x), y + along * (py - y)] : [x + along * ux, y + along * uy];
}

function moved(curve, [px, py], by) {  // along it
  const {x, y, r, ux, uy} = curve;
  return r ? footOn(curve, px - by * (py - y) / r, py + by * (px - x) / r) : [px + by * ux, py + by * uy];
}

// Where two curves cross, at least at some degrees; at a tangent there is no corner.
function crossings(one, other) {
  if (one.r && other.r) {
    const dx = other.x - one.x, dy = other.y - one.y, d = Math.hypot(dx, dy), along = (d * d + one.r ** 2 - other.r ** 2) / (2 * d);
    const square = one.r ** 2 - along * along;
    if (!(square > (Math.min(one.r, other.r) / 10) ** 2)) return [];
    return [-1, 1].map(s => s * Math.sqrt(square)).map(h => [one.x + (along * dx - h * dy) / d, one.y + (along * dy + h * dx) / d]);
  }
  const [line, curve] = one.r ? [other, one] : [one, other], dx = curve.x - line.x, dy = curve.y - line.y;
  const ahead = dx * line.ux + dy * line.uy, beside = dy * line.ux - dx * line.uy;
  const turn = line.ux * curve.uy - line.uy * curve.ux;
  const ways = !curve.r ? Math.abs(turn) > 0.1 ? [(dx * curve.uy - dy * curve.ux) / turn] : []
    : Math.abs(beside) < 0.995 * curve.r ? [-1, 1].map(s => ahead + s * Math.sqrt(curve.r ** 2 - beside ** 2)) : [];
  return ways.map(t => [line.x + t * line.ux, line.y + t * line.uy]);
}

// The circle that lies best through places (least squares of Kasa); `off` is how far they lie off it.
function circleThrough(places) {
  const n = places.length, mean = k => places.reduce((sum, place) => sum + place[k], 0) / n, [mx, my] = [mean(0), mean(1)];
  let [xx, xy, yy, xq, yq, qq] = [0, 0, 0, 0, 0, 0];
  for (const [px, py] of places) {
    const x = px - mx, y = py - my, q = x * x + y * y;
    [xx, xy, yy, xq, yq, qq] = [xx + x * x, xy + x * y, yy + y * y, xq + x * q, yq + y * q, qq + q];
  }
  const whole = xx * yy - xy * xy, x = (xq * yy - yq * xy) / (2 * whole), y = (yq * xx - xq * xy) / (2 * whole), r = Math.sqrt(x * x + y * y + qq / n);
  const off = Math.max(...places.map(([px, py]) => Math.abs(Math.hypot(px - mx - x, py - my - y) - r)));
  return {d: 2 * r, centre: [mx + x, my + y], off};
}
