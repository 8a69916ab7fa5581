// The picture: grid and rulers, the path (what is done strong, what is to come pale), the tool.
// What does not change from frame to frame is kept in layers: the ground, over which the part is shown (see relief.js), the
// path ahead, and the strokes done so far.

const BESIDES = 0.04;  // of the size of the picture: how far a chuck may widen it

const CHUNK = 40;  // points of what is done that are drawn together, so that it looks the same played and jumped to
const LONG = 8000;  // points of a path from which on it is drawn in hairlines

class Picture {
  constructor(canvas, ground, run) {
    this.canvas = canvas;
    this.ground = ground;
    this.run = run;
    const rough = new Strokes(run.path, 0.5), size = box => box ? Math.hypot(...box[1].map((v, k) => v - box[0][k])) : 0;
    this.extent = size(rough.box(RAPIDS, CUTS, PROBINGS)) || 100;
    this.strokes = new Strokes(run.path, Math.max(1e-6, this.extent / 2e4), run.course, run.header.home, row => run.probes(row));
    this.contour = run.programmed && new Strokes(run.programmed, Math.max(1e-6, this.extent / 2e4));
    this.fills = [CUTS, PROBINGS];  // what fills the picture: rapids run out of it, where there is anything else
    if (!size(this.strokes.box(...this.fills))) this.fills.push(RAPIDS);
    this.box = this.strokes.box(...this.fills) || [run.path.vertex(0).map(v => v - 10), run.path.vertex(0).map(v => v + 10)];
    const {axis, chuck} = run.header.section || {axis: 0, chuck: []};
    const held = chuck.flat().flatMap(([z, r]) => [[axis + r, 0, z], [axis - r, 0, z]]), widen = (points, most) => {
      const [low, high] = this.box.map(corner => corner.slice());
      for (const point of points)
        point.forEach((value, k) => {
          this.box[0][k] = Math.min(this.box[0][k], Math.max(value, low[k] - most));
          this.box[1][k] = Math.max(this.box[1][k], Math.min(value, high[k] + most));
        });
    };
    this.solid = [...run.stock.flat(), ...run.header.felt.corners];
    widen([...this.solid, ...run.lathe ? [[axis, 0, this.box[0][2]]] : []], Infinity);  // a turned path says little without the axis
    widen(held, BESIDES * size(this.box));
    this.extent = Math.max(size(this.box), 1);
    this.long = this.strokes.n > LONG;
    this.fewRapids = this.strokes.kind.reduce((n, kind) => n + (kind === RAPIDS), 0) < 3000;
    this.touches = new Touches(run);
    this.camera = new Camera(run.lathe);
    this.turning = run.chain && new Turning(this, run.chain);
    this.ahead = document.createElement("canvas");
    this.done = document.createElement("canvas");
    this.drawn = -1;  // the last point of the strokes in the layer of what is done
    this.stale = this.fitted = this.rapids = true;
    this.version = 0;  // counts the pictures that are not but the one before, gone on
    this.recolour();
  }
  // From where to where what fills the picture lies along a direction.
  reach(d) {
    const [least, most] = this.turning ? this.turning.reach(d) : [Infinity, -Infinity];
    if (this.turning && this.turning.moves) return [least, most];
    const {strokes} = this, along = ([x, y, z]) => x * d[0] + y * d[1] + z * d[2], solid = this.solid.map(along);
    const [lows, highs] = [0, 1].map(k => [strokes, this.contour].filter(Boolean).map(each => each.reach(d, this.fills)[k]));
    const [low, high] = [Math.min(...lows), Math.max(...highs)];
    if (this.run.lathe || low > high) {  // the chuck, and what is turned, lie on both sides of the axis
      const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(k => along(this.box[k & 1].map((_, axis) => this.box[k >> axis & 1][axis])));
      return [Math.min(...corners), Math.max(...corners)];
    }
    return [solid.reduce((a, b) => Math.min(a, b), Math.min(low, least)), solid.reduce((a, b) => Math.max(a, b), Math.max(high, most))];
  }
  recolour() {
    const style = getComputedStyle(document.documentElement);
    this.colours = Object.fromEntries(["paper", "ink", "faint", "rapid", "cut", "probing", "contour", "blank", "now", "cutter", "shank",
      "edge", "quiet", "raw", "metal", "deep", "crash", "alarm", "chuck", "insert", "holder", "beam", "turning", "plane",
      "c0", "c1", "c2", "c3", "c4", "c5"].map(name => [name, style.getPropertyValue("--" + name).trim()]));
    this.stale = true;
  }
  resize() {
    const box = this.canvas.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
    const [w, h] = [Math.max(1, Math.round(box.width)), Math.max(1, Math.round(box.height))];
    if (this.camera.size[0] === w && this.camera.size[1] === h && this.ratio === ratio) return;
    const scale = Math.min(w / this.camera.size[0], h / this.camera.size[1]);
    this.ratio = ratio;
    this.camera.size = [w, h];
    for (const each of [this.canvas, this.ground, this.ahead, this.done]) [each.width, each.height] = [w * ratio, h * ratio];
    if (this.fitted) this.camera.fit(d => this.reach(d)); else this.camera.zoom *= scale;
    this.stale = true;
  }
  fit(whole = false) {  // of a machine with a head, as far as its axes
    if (this.turning) this.turning.whole = whole;
    this.camera.fit(d => this.reach(d));
    this.fitted = true;  // until a person zooms or shifts: a frame may get its size late
    this.stale = true;
  }
  view(name) {
    this.camera.turnTo(name);
    this.fit();
  }

  pen(canvas) {
    const pen = canvas.getContext("2d");
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    return pen;
  }
  lines(pen, from, to, pale) {
    const {rapid, cut, probing} = this.colours;
    const {shades} = this, shaded = shades && shades.of;
    pen.globalAlpha = pale ? 0.28 : this.part && !shaded ? 0.55 : 1;  // the part shows through what was done
    pen.lineJoin = this.long ? "bevel" : "round";
    for (const [kind, colour, width, dashes] of [[CUTS, cut, 1.8, []], [RAPIDS, rapid, 1, this.fewRapids ? [5, 3] : []],
      [PROBINGS, probing, 1.4, [1.5, 2]]]) {
      if (kind === RAPIDS && !this.rapids) continue;
      pen.strokeStyle = colour;
      pen.lineWidth = this.long ? 1 / this.ratio : pale || (this.part && !shaded) ? Math.min(width, 1.2) : width;  // hairlines cost a tenth
      pen.setLineDash(dashes);
      if (kind !== CUTS || !shaded) this.strokes.stroke(pen, kind, from, to);
      else for (const shade of shades.seen) {
        pen.strokeStyle = this.colours[shades.classes[shade][0]];
        this.strokes.stroke(pen, CUTS, from, to, shaded, shade);
      }
    }
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  }

  // One frame: `at` is {row, tip, tool, along, at}, the row going on (or -1) and what stands at its tip.
  draw(at, rowsDone) {
    const {camera, strokes} = this, [w, h] = camera.size, inSpace = this.part && this.part.inSpace;
    this.shown = {at, rowsDone};
    if (this.turning && this.turning.carry(at.angles)) this.stale = true;
    if (this.stale) {
      strokes.project(camera);
      if (this.contour) this.contour.project(camera);
      const ground = this.pen(this.ground), pen = this.pen(this.ahead);
      ground.fillStyle = this.colours.paper;
      ground.fillRect(0, 0, w, h);
      pen.clearRect(0, 0, w, h);
      const words = this.rulers(ground);
      if (!inSpace) this.blank(pen);
      if (this.contour && !inSpace) {
        pen.strokeStyle = this.colours.contour;
        pen.lineWidth = this.long ? 1 / this.ratio : 1;
        this.contour.stroke(pen, CUTS, 0, this.contour.n - 1);
      }
      if (!inSpace) this.lines(pen, 0, strokes.n - 1, true);
      words(pen);
      this.drawn = -1;
      this.stale = false;
      this.version++;
    }
    const until = strokes.after[rowsDone], pen = this.pen(this.done), whole = until - until % CHUNK;
    if (this.drawn < 0 || whole < this.drawn) {
      pen.clearRect(0, 0, w, h);
      this.drawn = 0;
    }
    for (; this.drawn < whole; this.drawn += CHUNK) if (!inSpace) this.lines(pen, this.drawn, this.drawn + CHUNK, false);
    const top = this.canvas.getContext("2d");
    top.setTransform(1, 0, 0, 1, 0, 0);
    top.clearRect(0, 0, this.canvas.width, this.canvas.height);
    top.drawImage(this.ahead, 0, 0);
    if (!inSpace) {
      top.drawImage(this.done, 0, 0);
      this.lines(this.pen(this.canvas), whole, until, false);
    }
    const taken = this.moment(this.pen(this.canvas), at);
    this.touches.draw(this.pen(this.canvas), camera, this.colours, rowsDone, taken, inSpace ? at => this.part.sees(at) : undefined);
  }

  blank(pen) {  // and what holds it
    if (this.run.header.turning) this.drum(pen);
    pen.lineWidth = 1;
    for (const [lines, colour] of [[this.run.header.fixtures, "edge"], [this.run.stock, "blank"], [[this.run.header.felt.beam], "beam"]]) {
      pen.strokeStyle = this.colours[colour];
      pen.beginPath();
      for (const edge of lines) edge.forEach((point, k) => pen[k ? "lineTo" : "moveTo"](...this.camera.project(point)));
      pen.stroke();
    }
  }

  drum(pen) {  // what is turned under the tool: a plain body, which is not cut
    const {camera: {near}, camera, colours, run: {stock}} = this, depth = ([x, y, z]) => x * near[0] + y * near[1] + z * near[2];
    const ends = stock.filter(edge => edge.length > 2).sort(([a], [b]) => depth(a) - depth(b)), project = point => camera.project(point);
    pen.fillStyle = colours.raw;
    pen.globalAlpha = 0.3;
    for (const outline of [hull(stock.flat().map(project)), ...ends.slice(-1).map(edge => edge.map(project))]) {
      trace(pen, outline);
      pen.fill();
    }
    pen.globalAlpha = 1;
  }

  // How places about the tip are projected: those of a tool that stands tilted, or round which a drum has turned.
  beside(tip, angles) {
    if (this.turning) {
      const ways = this.run.chain.tool(angles);
      return point => this.camera.project(tip.map((v, k) => v + ways.reduce((sum, way, n) => sum + way[k] * (point[n] - tip[n]), 0)));
    }
    const [[...drum]] = this.run.header.turning || [[]], angle = (angles || [])[drum.pop()] * Math.PI / 180;
    if (!angle) return point => this.camera.project(point);
    return point => this.camera.project(turned(point.map((v, k) => v - tip[k]), drum, angle).map((v, k) => v + tip[k]));
  }
  // Returns the boxes of what is written.
  moment(pen, {row, tip, tool, along, at, angles, length, step}) {
    const {camera, colours, strokes, run} = this, project = point => camera.project(point);
    const inSpace = this.part && this.part.inSpace;
    if (row >= 0 && run.path.isMotion(row) && !inSpace) {
      pen.strokeStyle = colours.now;
      pen.lineWidth = 2.6;
      for (const kind of [RAPIDS, CUTS, PROBINGS]) strokes.stroke(pen, kind, strokes.after[row], strokes.after[row + 1]);
    }
    this.written = [];
    const boxes = this.turning ? this.triad(pen) : [];
    if (this.turning) {
      const rings = inSpace && tool ? parts(tool, this.extent, true) : [], beside = this.beside(tip, angles);
      this.turning.draw(pen, {tip, angles, length, step}, rings.map(([part]) => hull(part.flatMap(each => ring(each, tip, along, beside)))));
    }
    const held = run.lathe && run.inserts.tools[run.inserts.which.value(row < 0 ? at : row) || 0];
    if (held && !inSpace) drawInsert(pen, held, tip, project, colours);
    else if (!run.lathe && !inSpace && tool && (tool.number || tool.radius)) drawTool(pen, tool, tip, along, this.beside(tip, angles), colours, this.extent, Boolean(this.turning));
    const [x, y] = project(tip);
    pen.beginPath();
    pen.arc(x, y, 3.2, 0, 7);
    pen.fillStyle = colours.now;
    pen.strokeStyle = colours.paper;
    pen.lineWidth = 1;
    pen.fill();
    pen.stroke();
    return [[x - 5, y - 5, x + 5, y + 5], ...this.turning ? boxes : this.triad(pen)];
  }

  // Axes of the work offset at its zero point.
  triad(pen) {
    const {camera, colours} = this, size = 34 / camera.zoom, zero = camera.project([0, 0, 0]);
    const names = this.run.lathe ? ["X", "", "Z"] : ["X", "Y", "Z"], boxes = [];
    pen.font = "600 11px system-ui, sans-serif";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    const ends = [0, 1, 2].map(k => camera.project([0, 1, 2].map(axis => axis === k ? size : 0)));
    names.forEach((name, k) => {
      const end = ends[k];
      const dx = end[0] - zero[0], dy = end[1] - zero[1], length = Math.hypot(dx, dy);
      if (!name || length < 8) return;
      pen.strokeStyle = pen.fillStyle = colours.ink;
      pen.lineWidth = 1.4;
      pen.beginPath();
      pen.moveTo(...zero);
      pen.lineTo(...end);
      pen.stroke();
      const away = ([x, y]) => Math.min(...ends.map((each, n) => n === k ? Infinity : gap([x, y], zero, each)), ...boxes.map(([a, b]) => Math.hypot(x - a - 6, y - b - 7)));
      const spots = [[9, 0], [0, 11], [0, -11]].map(([on, aside]) => [end[0] + (on * dx - aside * dy) / length, end[1] + (on * dy + aside * dx) / length]);
      const [lx, ly] = spots.find(spot => away(spot) > 10) || spots[0];  // beside an axis that another one covers
      pen.strokeStyle = colours.paper;
      pen.lineWidth = 3;
      pen.strokeText(name, lx, ly);
      pen.fillText(name, lx, ly);
      boxes.push([lx - 6, ly - 7, lx + 6, ly + 7]);
      this.written.push(boxes[boxes.length - 1]);
    });
    return boxes;
  }

  // Along the axes: a grid with numbers. Else: a bar of a round length. Returns what writes the numbers over the rest.
  rulers(pen) {
    const {camera, colours, run} = this, [w, h] = camera.size;
    const across = camera.along(camera.right), upwards = camera.along(camera.up);
    pen.font = "11px system-ui, sans-serif";
    pen.lineWidth = 1;
    if (!across || !upwards) return over => this.bar(over);
    const words = [], names = "XYZ", {length, short: unit} = run.unit, diameter = k => run.lathe && k === 0 ? 2 : 1;
    for (const [[axis], flat] of [[across, true], [upwards, false]]) {
      const parts = diameter(axis) / length, step = round(58 / camera.zoom * parts) / parts;
      const digits = Math.max(0, -Math.floor(Math.log10(step * parts) + 1e-9));
      const middle = camera.target[axis], half = (flat ? w : h) / 2 / camera.zoom;
      for (let k = Math.ceil((middle - half) / step); k <= (middle + half) / step; k++) {
        const point = camera.target.slice();
        point[axis] = k * step;
        const [x, y] = camera.project(point).map(value => Math.round(value) + 0.5);
        pen.strokeStyle = k === 0 ? colours.quiet : colours.faint;
        pen.setLineDash(k === 0 && run.lathe && !flat ? [14, 4, 2, 4] : []);
        pen.beginPath();
        pen.moveTo(flat ? x : k === 0 ? 20 : 0, flat ? 0 : y);  // clear of the number: it would read as its sign
        pen.lineTo(flat ? x : w, flat ? h : y);
        pen.stroke();
        const text = number(Math.abs(k * step * parts) * (run.lathe && axis === 0 ? 1 : Math.sign(k)), digits);
        if (flat ? x > 46 && x < w - 48 : y > 26 && y < h - 26) words.push([text, flat ? x : 5, flat ? h - 5 : y, flat ? "center" : "left", flat ? "bottom" : "middle"]);
      }
      pen.setLineDash([]);
      const name = (diameter(axis) > 1 ? "⌀ X " : names[axis] + " ") + unit;
      words.push([name, flat ? w - 6 : 5, flat ? h - 5 : 6, flat ? "right" : "left", flat ? "bottom" : "top"]);
    }
    return over => {
      over.font = pen.font;
      over.fillStyle = colours.quiet;
      for (const [text, x, y, align, baseline] of words) {
        over.textAlign = align;
        over.textBaseline = baseline;
        this.label(over, text, x, y);
      }
    };
  }
  label(pen, text, x, y) {
    pen.strokeStyle = this.colours.paper;
    pen.lineWidth = 5;
    pen.lineJoin = "round";
    pen.strokeText(text, x, y);
    pen.lineWidth = 1;
    pen.fillText(text, x, y);
  }
  // A label at the first of some places in the picture where none is yet.
  spread(pen, text, spots) {
    const wide = pen.measureText(text).width / 2 + 2, [x, y] = spots.find(spot => this.clear(spot, wide)) || spots[0];
    this.written.push([x - wide, y - 7, x + wide, y + 7]);
    this.label(pen, text, x, y);
  }
  clear([x, y], wide) {
    const [w, h] = this.camera.size;
    return x > wide && x < w - wide && y > 7 && y < h - 7 && this.written.every(([left, top, right, bottom]) => x + wide < left || x - wide > right || y + 7 < top || y - 7 > bottom);
  }
  bar(pen) {
    const {camera, colours} = this, [, h] = camera.size, {unit} = this.run, length = round(60 / camera.zoom / unit.length), wide = length * unit.length * camera.zoom;
    pen.font = "11px system-ui, sans-serif";
    pen.lineWidth = 1;
    pen.strokeStyle = pen.fillStyle = colours.quiet;
    pen.beginPath();
    for (const [x, y] of [[10, h - 17], [10, h - 11], [10 + wide, h - 11], [10 + wide, h - 17]]) pen.lineTo(x, y);
    pen.stroke();
    pen.textAlign = "left";
    pen.textBaseline = "bottom";
    pen.fillText(number(length, Math.max(0, -Math.floor(Math.log10(length) + 1e-9))) + ` ${unit.short}`, 14, h - 15);
  }
}

// How far a place is from a line between two others.
function gap([x, y], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay], u = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(ax + u * dx - x, ay + u * dy - y);
}

// The next of 1, 2, 5, 10 … that is not below a length.
function round(length) {
  const ten = 10 ** Math.floor(Math.log10(length));
  return [1, 2, 5, 10].map(k => k * ten).find(value => value >= length * (1 - 1e-9));
}

// A number with a fixed count of decimals, a true minus, and no negative zero.
function number(value, decimals) {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}
