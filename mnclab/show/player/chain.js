// A machine whose rotary axes turn the tool and the part: where they are then, and how the page shows it. A place is told as it is on
// the part while all axes stand at zero, or as the machine has it; the camera of the machine is carried along with the part, so that
// what is drawn where it is on the part is seen where it is on the machine.

const RINGS = 0.34, WIDER = 0.07;  // of the size of the picture: the ring about the first axis, and how much more the next ones have
const DEGREE = Math.PI / 180;
const SPOTS = [1.09, 1.24, 0.92, 1.39, 0.77, 0.5, 0.3];  // where a label may stand, of the length of what it names
const SEEN = 14;  // pixels: shorter axes point at whoever looks, and have no name
const FONT = "600 11px system-ui, sans-serif";

class Chain {
  constructor(columns, {head, table, home, length, plane, corrected}) {
    Object.assign(this, {head, table, home, corrected, length: new Log(columns, length), plane: new Log(columns, plane)});
  }
  // As it is in a row, where a cycle may have corrected it.
  in(row) {
    const found = this.corrected.filter(each => row >= each.row).pop();
    return found ? Object.assign(Object.create(Chain.prototype), this, found) : this;
  }
  after(row) {  // the length of the tool after a row, mm
    return this.length.value(row + 1);
  }
  get axes() {  // by their names
    return [...this.table, ...this.head].sort((a, b) => a.number - b.number);
  }
  // A place turned about an axis.
  static about({centre, line}, place, angle) {
    return turned(place.map((v, k) => v - centre[k]), line, angle).map((v, k) => v + centre[k]);
  }
  angle(axis, angles) {
    return angles[axis.number] * DEGREE;
  }
  // From the machine to the part, whose table axes have turned, and back; of some axes from one on.
  toPart(place, angles, from = 0) {
    return this.table.slice(from).reduce((at, axis) => Chain.about(axis, at, this.angle(axis, angles)), place);
  }
  toMachine(place, angles) {
    return this.table.reduceRight((at, axis) => Chain.about(axis, at, -this.angle(axis, angles)), place);
  }
  along(way, angles, from = 0) {  // a direction of the machine, on the part
    return this.table.slice(from).reduce((v, axis) => turned(v, axis.line, this.angle(axis, angles)), way);
  }
  swung(way, angles, until = this.head.length) {  // a direction of the head at zero, as it has turned
    return this.head.slice(0, until).reduceRight((v, axis) => turned(v, axis.line, this.angle(axis, angles)), way);
  }
  arm(place, angles, until = this.head.length) {  // a place from the spindle reference, as the head has turned
    return this.head.slice(0, until).reduceRight((at, axis) => Chain.about(axis, at, this.angle(axis, angles)), place);
  }
  // The directions of a tool on the part: across, across, along.
  tool(angles) {
    return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(way => this.along(this.swung(way, angles), angles));
  }
  // Where the spindle reference is, as the machine has it, for a tip on the part.
  reference(tip, angles, length) {
    const arm = this.arm([0, 0, -length], angles);
    return this.toMachine(tip, angles).map((v, k) => v - arm[k]);
  }
  // Each axis as a ring: its middle, a direction to where it begins to count and one to where it stands, all on the part. `near` is
  // a place that the rings of a table stand by.
  rings(tip, angles, length, near) {
    const reference = this.reference(tip, angles, length), across = ({line}) => {
      const other = [0, 1, 2].sort((a, b) => Math.abs(line[a]) - Math.abs(line[b]))[0], u = [0, 1, 2].map(k => (k === other) - line[other] * line[k]);
      return u.map(v => v / Math.hypot(...u));
    };
    return [...this.table.map((axis, k) => {
      const off = axis.line.reduce((sum, v, n) => sum + v * (near[n] - axis.centre[n]), 0), foot = axis.centre.map((v, n) => v + off * axis.line[n]);
      const on = way => this.along(way, angles, k + 1);  // the part turns back, seen from the machine
      return {axis, middle: this.toPart(foot, angles, k + 1), line: on(axis.line), zero: on(turned(across(axis), axis.line, this.angle(axis, angles))), stands: on(across(axis))};
    }), ...this.head.map((axis, k) => {
      const on = way => this.along(this.swung(way, angles, k), angles), at = this.arm(axis.centre, angles, k).map((v, n) => v + reference[n]);
      return {axis, middle: this.toPart(at, angles), line: on(axis.line), zero: on(across(axis)), stands: on(turned(across(axis), axis.line, this.angle(axis, angles)))};
    })];
  }
  // The places where a box of the part stands on the machine, whatever row is done.
  swept(box, rotary) {
    const seen = new Map([["", this.home]]), n = rotary[0].length, step = Math.max(1, Math.floor(n / 500));
    for (let row = 0; row < n; row += step) {
      const angles = rotary.map(column => column[row]);
      seen.set(angles.map(angle => Math.round(angle)).join(), angles);
    }
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(k => [0, 1, 2].map(axis => box[k >> axis & 1][axis]));
    return [...seen.values()].flatMap(angles => corners.map(corner => this.toMachine(corner, angles)));
  }
}

// What of a machine is drawn over the picture: rings of its axes with their angles, the plane that is tilted, the arm to a head.
class Turning {
  constructor(picture, chain) {
    Object.assign(this, {picture, chain, moves: chain.table.length > 0});  // whether the part turns
    this.middle = [0, 1, 2].map(k => (picture.box[0][k] + picture.box[1][k]) / 2);
    const rings = chain.rings(this.middle, [0, 0, 0], 0, this.middle).slice(0, chain.table.length).filter(({middle}) => Math.hypot(...middle.map((v, k) => v - this.middle[k])) < picture.extent);
    this.swept = [...chain.swept(picture.box, picture.run.rotary), ...rings.flatMap(({middle}, n) => [0, 1, 2].flatMap(axis => [-1, 1].map(sense =>
      middle.map((v, k) => v + (k === axis) * sense * picture.extent * (RINGS + WIDER * n)))))];  // the rings where they are by the part
  }
  // The middles of the rings of a head and the tips, on the part, of some rows.
  get heads() {
    if (this.pivots) return this.pivots;
    const {chain, picture: {run: {path, rotary}}} = this, step = Math.max(1, Math.floor(path.n / 200)), found = [];
    for (let row = 0; row < path.n; row += step) {
      const angles = rotary.map(column => column[row]), tip = path.vertex(row + 1);
      if (path.isMotion(row) && path.kind[row] !== RAPID) found.push(tip, ...chain.rings(tip, angles, chain.after(row), this.middle).slice(chain.table.length).map(({middle}) => middle));
    }
    return this.pivots = found;
  }
  // The camera goes with the part, or stands by it; true where it has turned.
  carry(angles) {
    const {chain, picture: {camera}} = this, now = this.moves ? angles : [0, 0, 0], before = this.carried || [0, 0, 0];
    if (chain.table.every(({number}) => now[number] === before[number])) return false;
    camera.target = chain.toPart(chain.toMachine(camera.target, before), now);
    camera.turned = way => chain.along(way, now);
    camera.update();
    this.carried = now;
    return true;
  }
  // From where to where what fills the picture lies along a direction on the part, whichever way it will turn; with a head, as
  // far as its axes, where that is asked for.
  reach(d) {
    const {chain, carried: now = [0, 0, 0], whole, picture: {extent}} = this, along = at => at[0] * d[0] + at[1] * d[1] + at[2] * d[2];
    const all = this.moves ? this.swept.map(place => along(chain.toPart(place, now))) : [], room = extent * RINGS;
    if (whole) all.push(...this.heads.map(along).flatMap(v => [v - room, v + room]));
    return [Math.min(...all), Math.max(...all)];
  }
  // `outlines` are those of a tool that is in the picture already.
  draw(pen, {tip, angles, length, step}, outlines) {
    const {chain, picture, picture: {camera, colours, extent}} = this, project = place => camera.project(place);
    this.plane(pen, chain.plane.value(step), outlines);
    const rings = chain.rings(tip, angles, length, this.middle), go = (from, ways, sizes) => from.map((v, k) => v + ways.reduce((sum, way, n) => sum + way[k] * sizes[n], 0));
    pen.lineCap = "butt";
    rings.forEach(({axis, middle, line, zero, stands}, k) => {
      const size = extent * (RINGS + WIDER * k), side = turned(zero, line, Math.PI / 2), angle = angles[axis.number], head = k >= chain.table.length;
      const place = a => project(go(middle, [zero, side], [size * Math.cos(a), size * Math.sin(a)])), turn = (head ? 1 : -1) * angle * DEGREE;
      const arc = (from, to) => {
        const count = Math.max(2, Math.ceil(Math.abs(to - from) / 0.1));
        pen.beginPath();
        for (let n = 0; n <= count; n++) pen[n ? "lineTo" : "moveTo"](...place(from + (to - from) * n / count));
        pen.stroke();
      };
      Object.assign(pen, {strokeStyle: colours.quiet, lineWidth: 0.9, globalAlpha: 0.8});
      pen.setLineDash([10, 3, 2, 3]);  // its line
      pen.beginPath();
      for (const end of [-1.25, 1.25]) pen.lineTo(...project(go(middle, [line], [end * size])));
      pen.stroke();
      pen.setLineDash([]);
      pen.globalAlpha = 0.35;
      arc(0, 2 * Math.PI);
      Object.assign(pen, {strokeStyle: colours.turning, lineWidth: 2.4, globalAlpha: 1});
      if (turn) arc(0, Math.abs(turn) > 2 * Math.PI ? Math.sign(turn) * 2 * Math.PI : turn);
      for (const [way, wide] of [[zero, 1], [stands, 2]]) {
        pen.lineWidth = wide;
        pen.beginPath();
        for (const far of [0.93, 1.05]) pen.lineTo(...project(go(middle, [way], [far * size])));
        pen.stroke();
      }
      pen.fillStyle = colours.turning;
      Object.assign(pen, {font: FONT, textAlign: "center", textBaseline: "middle"});
      picture.spread(pen, `${axis.name} ${short(angle)}°`, SPOTS.map(far => project(go(middle, [stands], [1.1 * far * size]))));
    });
    if (chain.head.length) this.arm(pen, [tip, go(tip, chain.tool(angles).slice(2), [length]), ...rings.slice(chain.table.length).map(({middle}) => middle).reverse()]);
  }
  arm(pen, places) {  // from the tip along the tool and to the axes of the head
    pen.strokeStyle = this.picture.colours.edge;
    pen.lineWidth = 1;
    pen.setLineDash([2, 3]);
    pen.beginPath();
    for (const place of places) pen.lineTo(...this.picture.camera.project(place));
    pen.stroke();
    pen.setLineDash([]);
  }
  plane(pen, frame, outlines) {  // a square about its zero point with its axes, behind a tool that one sees from its side
    if (!frame) return;
    const {picture: {camera, colours, extent}} = this, size = 0.5 * extent, at = (x, y, z = 0) => camera.project([0, 1, 2].map(k => frame[k][3] + x * frame[k][0] + y * frame[k][1] + z * frame[k][2]));
    pen.save();
    if (camera.near.reduce((sum, v, k) => sum + v * frame[k][2], 0) > 0) for (const outline of outlines) {
      trace(pen, outline);
      pen.rect(0, 0, ...camera.size);
      pen.clip("evenodd");
    }
    pen.beginPath();
    for (const [x, y] of [[-size, -size], [size, -size], [size, size], [-size, size]]) pen.lineTo(...at(x, y));
    pen.closePath();
    Object.assign(pen, {fillStyle: colours.plane, strokeStyle: colours.plane, lineWidth: 1.2, globalAlpha: 0.13});
    pen.fill();
    pen.globalAlpha = 1;
    pen.stroke();
    const axes = [["X", 1, 0, 0], ["Y", 0, 1, 0], ["Z", 0, 0, 0.6]];
    axes.forEach(([, x, y, z]) => {
      Object.assign(pen, {strokeStyle: colours.plane, lineWidth: 1.6});
      pen.beginPath();
      pen.moveTo(...at(0, 0));
      pen.lineTo(...at(size * x, size * y, size * z));
      pen.stroke();
    });
    pen.restore();
    Object.assign(pen, {fillStyle: colours.plane, font: FONT, textAlign: "center", textBaseline: "middle"});
    const [x, y] = at(0, 0), long = ([, ...way]) => { const [u, v] = at(...way.map(v => size * v)); return Math.hypot(u - x, v - y) > SEEN; };
    for (const [name, ...way] of axes.filter(long)) this.picture.spread(pen, name, SPOTS.map(far => at(...way.map(v => far * size * v))));
  }
}
