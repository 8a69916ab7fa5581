// How high a cutter leaves the material along a piece of a move, as workpiece/milling/swept.py has it: the least height of
// its lower side over a place. A *piece* is {box, low, left(x, y), span(y)}: what it reaches, and between which x at a y.

const TOUCH = 1e-9;  // of a squared radius, by which a place on the rim is under the tool
const STILL = 1e-9;  // mm, below which a move does not go on in the plane
const HALVINGS = 14;  // of the place of the least height under a round corner

// Of a cutter [radius, flat, corner, slope]: the height of its edge above the tip at a squared distance from the axis.
function edgeHeight([radius, flat, corner, slope], square) {
  if (square > radius * radius * (1 + TOUCH)) return Infinity;
  if (flat >= radius) return 0;
  const out = Math.max(Math.sqrt(square) - flat, 0);
  return corner - Math.sqrt(Math.max(corner * corner - out * out, 0)) + slope * out;
}

// How far along its move from a place the cutter is that leaves it lowest, were the move without ends.
function lowestAt([radius, flat, corner, cone], beside, slope) {
  const rim = Math.sqrt(Math.max(radius * radius - beside, 0)), inner = Math.sqrt(Math.max(flat * flat - beside, 0));
  if (flat >= radius) return rim;
  if (cone > 0) {
    const free = slope >= cone ? rim : Math.sqrt(beside) * slope / Math.sqrt(cone * cone - slope * slope);
    return Math.min(Math.max(free, inner), rim);
  }
  if (flat === 0) return Math.sqrt(Math.max(corner * corner - beside, 0)) * slope / Math.sqrt(1 + slope * slope);
  let low = inner, high = rim;
  for (let k = 0; k < HALVINGS; k++) {
    const middle = (low + high) / 2, rho = Math.sqrt(beside + middle * middle), out = rho - flat;
    if (out * middle > slope * rho * Math.sqrt(Math.max(corner * corner - out * out, 0))) high = middle; else low = middle;
  }
  return (low + high) / 2;
}

function straightPiece(cutter, a, b) {
  const radius = cutter[0], [ax, ay, az] = a, [bx, by, bz] = b, dx = bx - ax, dy = by - ay, low = Math.min(az, bz);
  const length = Math.hypot(dx, dy), reach = radius * radius * (1 + TOUCH), still = length <= STILL;
  const ux = still ? 1 : dx / length, uy = still ? 0 : dy / length, slope = still ? 0 : (bz - az) / length, sense = Math.sign(slope);
  const box = [Math.min(ax, bx) - radius, Math.min(ay, by) - radius, Math.max(ax, bx) + radius, Math.max(ay, by) + radius];
  const left = (x, y) => {
    const px = x - ax, py = y - ay, ahead = px * ux + py * uy, beside = (px * uy - py * ux) ** 2;
    if (beside > reach) return Infinity;
    const best = slope === 0 ? ahead : ahead - sense * lowestAt(cutter, beside, Math.abs(slope));
    const place = Math.min(Math.max(best, 0), length), past = ahead - place;
    return (still ? low : az + slope * place) + edgeHeight(cutter, beside + past * past);
  };
  const span = y => {  // of two discs and the strip between them
    let from = Infinity, to = -Infinity;
    for (const [ex, ey] of [a, b]) {
      const wide = Math.sqrt(reach - (y - ey) ** 2);
      if (wide >= 0) [from, to] = [Math.min(from, ex - wide), Math.max(to, ex + wide)];
    }
    for (const side of [-radius, radius]) {
      const y0 = ay + side * ux, y1 = by + side * ux;
      if (y0 === y1 || (y0 - y) * (y1 - y) > 0) continue;
      const x = ax - side * uy + (y - y0) / (y1 - y0) * dx;
      [from, to] = [Math.min(from, x), Math.max(to, x)];
    }
    return [from, to];
  };
  return {box, low, left, span};
}

// An arc about Z at one height: from an angle on, by a turn of either sense.
function arcPiece(cutter, [cx, cy], round, first, turn, z) {
  const radius = cutter[0], reach = round + radius, whole = Math.abs(turn), sense = Math.sign(turn), bore = Math.max(round - radius, 0);
  const ends = [first, first + turn].map(angle => [cx + round * Math.cos(angle), cy + round * Math.sin(angle)]);
  const turned = angle => ((angle - first) * sense % (2 * Math.PI) + 2 * Math.PI) % (2 * Math.PI);
  const most = [0, 1, 2, 3].map(k => k * Math.PI / 2).filter(angle => turned(angle) <= whole)
    .map(angle => [cx + round * Math.cos(angle), cy + round * Math.sin(angle)]).concat(ends);
  const [xs, ys] = [0, 1].map(k => most.map(point => point[k]));
  const box = [Math.min(...xs) - radius, Math.min(...ys) - radius, Math.max(...xs) + radius, Math.max(...ys) + radius];
  const left = (x, y) => {
    const px = x - cx, py = y - cy, out = Math.sqrt(px * px + py * py);
    if (out > reach + TOUCH || out < bore - TOUCH) return Infinity;
    if (whole >= 2 * Math.PI || turned(Math.atan2(py, px)) <= whole) return z + edgeHeight(cutter, (out - round) ** 2);
    return z + edgeHeight(cutter, Math.min(...ends.map(([ex, ey]) => (x - ex) ** 2 + (y - ey) ** 2)));
  };
  return {box, low: z, left, span: () => [box[0], box[2]]};
}
