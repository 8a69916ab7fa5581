// Bodies as triangles, six numbers a corner (place, way out), and all of a run that is in space beside its part: path, tool,
// what holds the blank. A body of revolution is made of sides [radius, height, radius, height] that are turned about an axis.

const ROUND = 72;  // sides of a whole turn
const CREASED = Math.cos(0.6);  // of the angle between two sides, from which on an edge is seen between them

// Sides about an axis 0, 1 or 2 through a place, from an angle on by a turn; the way out is to the right of a side.
function revolved(sides, along = 2, first = 0, turn = 2 * Math.PI, zero = [0, 0, 0]) {
  const count = Math.max(1, Math.round(ROUND * turn / (2 * Math.PI))), found = new Float32Array(36 * count * sides.length);
  const [across, other] = [(along + 1) % 3, (along + 2) % 3], out = sides.map(([r0, h0, r1, h1]) => {
    const long = Math.hypot(r1 - r0, h1 - h0) || 1;
    return [(h1 - h0) / long, (r0 - r1) / long];
  });
  const way = (k, next, [ra, ha], [rb, hb]) => {  // at an end of a side: round, where the next one goes on without an edge
    const [a, b] = [out[k], out[next]], meet = b && Math.hypot(ra - rb, ha - hb) < 1e-6 && a[0] * b[0] + a[1] * b[1] > CREASED;
    return meet ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : a;
  };
  const turns = Array.from({length: count + 1}, (_, i) => [Math.cos(first + turn * i / count), Math.sin(first + turn * i / count)]);
  let at = 0;
  sides.forEach(([r0, h0, r1, h1], k) => {
    const before = k ? sides[k - 1] : [], after = k + 1 < sides.length ? sides[k + 1] : [];
    const n0 = way(k, k - 1, [r0, h0], before.slice(2)), n1 = way(k, k + 1, [r1, h1], after);
    for (let i = 0; i < count; i++)
      for (const [r, h, n, [c, s]] of [[r0, h0, n0, turns[i]], [r0, h0, n0, turns[i + 1]], [r1, h1, n1, turns[i + 1]],
        [r0, h0, n0, turns[i]], [r1, h1, n1, turns[i + 1]], [r1, h1, n1, turns[i]]]) {
        [found[at + across], found[at + other], found[at + along]] = [r * c + zero[across], r * s + zero[other], h + zero[along]];
        [found[at + 3 + across], found[at + 3 + other], found[at + 3 + along]] = [n[0] * c, n[0] * s, n[1]];
        at += 6;
      }
  });
  return found;
}

// The sides of an outline [radius, height] from the axis below round to the axis above.
function sidesOf(outline) {
  const all = [[0, outline[0][1]], ...outline, [0, outline[outline.length - 1][1]]];
  return all.slice(1).map(([r, h], k) => [...all[k], r, h]).filter(([r0, h0, r1, h1]) => r0 !== r1 || h0 !== h1);
}

// A box between two corners.
function boxed(low, high) {
  const found = [];
  for (const axis of [0, 1, 2])
    for (const sense of [0, 1])
      for (const [u, v] of [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]) {
        const place = [], way = [0, 0, 0];
        [place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]] = [sense, u, v];
        way[axis] = 2 * sense - 1;
        found.push(...place.map((end, k) => end ? high[k] : low[k]), ...way);
      }
  return found;
}

// A body over an outline of places (z, r), as thick to both sides of the plane of X and Z.
function prism(corners, thick) {
  const found = [], turned = corners.reduce((sum, [z, r], k) => {
    const [z1, r1] = corners[(k + 1) % corners.length];
    return sum + z * r1 - r * z1;
  }, 0) < 0 ? [...corners].reverse() : corners;
  turned.forEach(([z, r], k) => {
    const [z1, r1] = turned[(k + 1) % turned.length], long = Math.hypot(z1 - z, r1 - r) || 1, way = [(z - z1) / long, 0, (r1 - r) / long];
    const [a, b] = [-thick, thick], side = [[r, a, z], [r1, a, z1], [r1, b, z1], [r, a, z], [r1, b, z1], [r, b, z]];
    for (const place of side) found.push(...place, ...way);
    if (k > 0 && k < turned.length - 1)
      for (const y of [a, b]) for (const [cz, cr] of [turned[0], [z, r], [z1, r1]]) found.push(cr, y, cz, 0, Math.sign(y), 0);
  });
  return found;
}

// What is in space beside the part. `picture` has the strokes, the colours, and where the tool stands (`shown`).
class Beside {
  constructor(gl, run, picture) {
    const {strokes, contour} = picture, wireOf = ({x, y, z, n}, kinds) => {
      const points = new Float32Array(3 * n);
      for (let k = 0; k < n; k++) points.set([x[k], y[k], z[k]], 3 * k);
      return this.space.wire(points, kinds);
    };
    Object.assign(this, {run, picture, space: new Space(gl)});
    this.path = wireOf(strokes, this.told = this.kinds());
    this.contour = contour && wireOf(contour, contour.kind.map(kind => kind === CUTS ? CUTS : NOTHING));
    const edges = [...run.stock.map(edge => [edge, 1]), ...run.header.fixtures.map(edge => [edge, 2]), ...run.header.felt.beam.length ? [[run.header.felt.beam, 3]] : []];
    this.edges = this.space.wire(Float32Array.from(edges.flatMap(([edge]) => edge.flat())), Uint8Array.from(edges.flatMap(([edge, kind]) => edge.map((_, k) => k ? kind : 0))));
    const box = strokes.box(RAPIDS, CUTS, PROBINGS) || picture.box;
    this.box = [0, 1].map(k => box[k].map((v, axis) => (k ? Math.max : Math.min)(v, picture.box[k][axis])));
  }
  // How far from the target anything may lie.
  far({target}) {
    return this.box.flat().reduce((sum, v, k) => sum + Math.abs(v - target[k % 3]), 0) + 2 * this.picture.extent;
  }
  kinds() {  // of the lines to the points: rapids, cuts, probings, and cuts of a shade
    const {strokes, shades} = this.picture, of = this.shaded = shades && shades.of;
    return of ? strokes.kind.map((kind, k) => kind === CUTS ? 4 + of[strokes.row[k]] : kind) : strokes.kind;
  }
  // Where the tool and the path are others than before.
  changed(patch) {
    const {run: {path}, picture: {strokes, extent, turning, shown: {at: {row, tip, tool, along}, rowsDone}}, before} = this, until = strokes.after[rowsDone];
    const moves = row >= 0 && path.isMotion(row) ? [strokes.after[row], strokes.after[row + 1]] : null, outline = tool ? parts(tool, extent, Boolean(turning)).flatMap(([rings]) => rings) : [];
    const wide = outline.reduce((most, [radius]) => Math.max(most, radius), 0), high = outline.reduce((most, [, height]) => Math.max(most, height), 0);
    const far = axis => turning ? wide + high : axis !== along ? wide : null;  // one that tilts may lie anywhere
    const body = [-1, 1].map(sense => tip.map((v, axis) => v + sense * (far(axis) ?? (sense > 0 ? high : 0))));
    this.before = {until, moves, body};
    if (!before || ["until", "moves", "body"].every(name => String(before[name]) === String(this.before[name]))) return;
    patch.addLines(strokes, before.until, until);
    for (const each of [before.moves, moves]) if (each && String(before.moves) !== String(moves)) patch.addLines(strokes, ...each);
    for (const each of [before.body, body]) patch.addBox(...each);
  }
  draw(patch = null) {
    const {space, run, picture, path} = this, {strokes, contour, colours, shades, shown: {at: {row, tip, tool, along, at, angles}, rowsDone}} = picture;
    if (this.shaded !== (shades && shades.of)) space.paint(path, this.told = this.kinds());
    const some = (lines, kinds, from, to, width) => patch && lines.sx ? patch.lines(lines, kinds, from, to, !width) : null;
    const until = strokes.after[rowsDone], hair = picture.long, wide = width => hair ? 0 : width;
    const rapid = picture.rapids && [colours.rapid, ...picture.fewRapids ? [5, 3] : []], dots = [colours.probing, 1.5, 2];
    const looks = [null, rapid, [colours.cut], dots, ...shades && shades.of ? shades.classes.map(([name]) => [colours[name]]) : []];
    run.header.held.forEach((body, k) => space.fill(space.body(`held ${k}`, () => this.held(body)), rgb(colours.chuck)));
    space.stroke(this.edges, 0, this.edges.count, [null, [colours.blank], [colours.edge], [colours.beam]], 1);
    if (this.contour) space.stroke(this.contour, 0, this.contour.count, [null, null, [colours.contour]], wide(1), 1, some(contour, contour.kind, 0, this.contour.count, wide(1)));
    space.stroke(path, until, strokes.n - 1, looks, wide(1.2), 0.28, some(strokes, this.told, until, strokes.n - 1, wide(1)));
    space.stroke(path, 0, until, looks, wide(1.4), 0.85, some(strokes, this.told, 0, until, wide(1)));
    if (row >= 0 && run.path.isMotion(row)) {
      const now = [null, ...Array(3 + MOST_SHADES + 1).fill([colours.now])];
      space.stroke(path, strokes.after[row], strokes.after[row + 1], now, 2.6);
    }
    if (run.lathe) this.insert(run.inserts.tools, run.inserts.which.value(row < 0 ? at : row) || 0, tip);
    else if (tool && (tool.number || tool.radius)) this.mill(tool, tip, along, run.chain ? run.chain.tool(angles).flat() : undefined);
  }
  held([low, high, at, bore]) {  // a box of two corners; or a profile [radius, height], its axis, where that stands, a bore
    if (!at) return boxed(low, high);
    const along = "XYZ".indexOf(high), [first, end] = [low[0], low[low.length - 1]], rising = first[1] < end[1] ? low : [...low].reverse();
    const outline = bore > 0 ? [...rising, [bore, rising[rising.length - 1][1]], [bore, rising[0][1]], rising[0]] : rising;
    return revolved(bore > 0 ? outline.slice(1).map(([r, h], k) => [...outline[k], r, h]) : sidesOf(outline), along, 0, 2 * Math.PI, at);
  }
  mill(tool, tip, along, turn) {
    const {space, picture: {extent, colours}} = this, key = JSON.stringify([tool, along]);
    for (const [k, [outline, colour]] of parts(tool, extent, Boolean(turn)).entries()) {
      const body = space.body(`tool ${k}`, () => revolved(sidesOf(outline), along), key);
      space.fill(body, rgb(colours[colour === "cutter" ? "metal" : "chuck"]), {at: tip, turn, alpha: 0.8, solid: true});
    }
  }
  insert(tools, which, tip) {
    const {space, picture: {colours}} = this;
    for (const [name, corners, thick] of blades(tools[which]))
      space.fill(space.body(`${name} ${which}`, () => prism(corners, thick)), rgb(colours[name]), {at: tip});
  }
}
