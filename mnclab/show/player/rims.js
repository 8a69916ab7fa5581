// The edges of a turned part about a place of its section: those of the bar and of the areas taken away, which are exact but
// for arcs: these come as chords, and a circle is laid through their corners.

const BESIDE = 0.03;  // mm off an edge, more than a chord lies off its arc
const BENT = 0.75;  // radians between two chords of one arc, at most

class Rims {
  constructor(section) {
    this.section = section;
    this.pen = document.createElement("canvas").getContext("2d");
  }
  // The place (z, r) of the section under one of the screen, and on which side of the axis it lies.
  under(camera, x, y) {
    const {axis} = this.section.section, zero = camera.project([axis, 0, 0]);
    const [z, r] = [[axis, 0, 1], [axis + 1, 0, 0]].map(end => camera.project(end).map((v, k) => v - zero[k]));
    const whole = z[0] * r[1] - z[1] * r[0], [dx, dy] = [x - zero[0], y - zero[1]], high = (z[0] * dy - z[1] * dx) / whole;
    return Math.abs(whole) < camera.zoom ** 2 / 20 ? null : {at: [(dx * r[1] - dy * r[0]) / whole, Math.abs(high)], side: Math.sign(high) || 1};
  }
  near({at: [z, r], side}, reach) {
    const {axis} = this.section.section, {rings, areas, bar, done} = this.section, {pen} = this, curves = new Map();
    const meets = ({box}) => z > box[0] - reach && z < box[2] + reach && r > box[1] - reach && r < box[3] + reach;
    const taken = areas.filter((_, k) => k < done && meets(rings[k])), space = r => [axis + side * r, 0];
    const solid = (z, r) => pen.isPointInPath(bar, z, Math.abs(r)) && !taken.some(area => pen.isPointInPath(area, z, Math.abs(r)));
    for (const ring of [...rings.slice(areas.length), ...rings.slice(0, done).filter(meets)])
      ring.z.forEach((_, k) => {
        const curve = edgeOf(ring, k), [fz, fr] = footOn(curve, z, r);
        if (Math.hypot(fz - z, fr - r) < reach && distance(ring, k, z, r) < 2 * reach)
          curves.set(["x", "y", "r"].map(name => (curve[name] || 0).toFixed(2)) + [curve.ux, curve.uy], curve);
      });
    const told = ({x, y, r, ux, uy}, [pz, pr]) => {
      const [nz, nr] = r ? [(pz - x) / r, (pr - y) / r] : [-uy, ux], [one, other] = [-BESIDE, BESIDE].map(s => solid(pz + s * nz, pr + s * nr));
      return one !== other;
    };
    const {edges, corners} = snaps([...curves.values()], [z, r], reach, 4 * BESIDE, told);
    return [
      ...edges.map(({curve, place: [pz, pr]}) => ({what: nameOf(curve), cost: EDGE, at: [...space(pr), pz], along: !curve.r && [side * curve.uy, curve.ux],
        round: curve.r && {d: 2 * curve.r, centre: [...space(curve.y), curve.x], off: curve.off}})),
      ...corners.map(({place: [pz, pr]}) => ({what: "corner", cost: CORNER, at: [...space(pr), pz]})),
    ];
  }
}

function nameOf({r, ux, uy}) {
  return r ? "arc" : Math.abs(uy) < 1e-3 ? "cylinder" : Math.abs(ux) < 1e-3 ? "face" : "cone";
}

function sideOf({z, r}, k) {  // from a corner to the next one
  const n = z.length, a = (k + n) % n, b = (k + n + 1) % n;
  return {z: z[a], r: r[a], dz: z[b] - z[a], dr: r[b] - r[a]};
}

function distance(ring, k, pz, pr) {
  const {z, r, dz, dr} = sideOf(ring, k), u = Math.min(1, Math.max(0, ((pz - z) * dz + (pr - r) * dr) / (dz * dz + dr * dr || 1)));
  return Math.hypot(z + u * dz - pz, r + u * dr - pr);
}

// The curve that a side of an outline lies on: a circle where its neighbours go on bending by the same angle, else a line.
function edgeOf(ring, k) {
  const {z, r, dz, dr} = sideOf(ring, k), long = Math.hypot(dz, dr) || 1;
  const turn = i => {
    const a = sideOf(ring, i), b = sideOf(ring, i + 1);
    return Math.atan2(a.dz * b.dr - a.dr * b.dz, a.dz * b.dz + a.dr * b.dr);
  };
  for (const bend of [turn(k - 1), turn(k)]) {
    if (Math.abs(bend) > BENT || Math.abs(bend) < 0.003) continue;
    let first = k, last = k;
    while (last - first < ring.z.length && Math.abs(turn(first - 1) - bend) < 0.1 * Math.abs(bend)) first--;
    while (last - first < ring.z.length && Math.abs(turn(last) - bend) < 0.1 * Math.abs(bend)) last++;
    const places = [];
    for (let i = first; i <= last + 1; i++) places.push([sideOf(ring, i).z, sideOf(ring, i).r]);
    const circle = last - first > 1 && circleThrough(places), half = bend * (last - first + 1) / 2;
    if (circle && circle.off < 0.002) return {x: circle.centre[0], y: circle.centre[1], r: circle.d / 2, off: Math.max(0.001, 1e-4 / half ** 2)};
  }
  return {x: z, y: r, ux: dz / long, uy: dr / long};
}
