// The part of a lathe: its section in the plane of Z and X, from which the area of each row is taken away, and of the row
// going on what the cutting part of the tool has passed over. What is done stands on a layer of its own.

const EVERY = 400;  // rows between two layers that are kept to go back from
const LAYERS = 8;

class ShownSection {
  constructor(canvas, run, picture) {
    const {section, columns} = run.header, [z, r] = section.corners.map(k => columns[k].map(v => v / section.parts));
    Object.assign(this, {canvas, run, picture, section, note: section.note});
    this.rows = columns[section.rows];
    [this.which, this.cuts] = ["which", "cuts"].map(name => new Log(columns, section[name]));
    let at = 0;
    this.areas = [];
    this.rings = [];  // their corners, and after them those of the bar
    for (const count of columns[section.count]) {
      const path = new Path2D(), own = {z: z.subarray(at, at + count), r: r.subarray(at, at + count), box: [Infinity, Infinity, -Infinity, -Infinity]};
      for (let k = 0; k < count; k++, at++) {
        path[k ? "lineTo" : "moveTo"](z[at], r[at]);
        own.box = [Math.min(own.box[0], z[at]), Math.min(own.box[1], r[at]), Math.max(own.box[2], z[at]), Math.max(own.box[3], r[at])];
      }
      path.closePath();
      this.areas.push(path);
      this.rings.push(own);
    }
    this.bar = new Path2D();
    section.bar.forEach(loop => this.bar.addPath(outline(loop)));
    this.rings.push(...section.bar.map(loop => ({z: loop.map(([z]) => z), r: loop.map(([, r]) => r)})));
    this.rims = new Rims(this);
    this.body = new TurnedBody(this);
    this.layer = document.createElement("canvas");
    this.kept = [];  // [areas taken, canvas]
    this.done = -1;  // areas that the layer has lost
    this.key = "";
    this.crashed = new Set(run.header.collisions.filter(each => each.kind === "rapid").map(each => each.row));
    this.radius = Math.max(...section.bar.flat().map(([, radius]) => radius));
  }
  get inSpace() {  // but for the view of the drawing, in which the section is one
    return Boolean(this.body.gl) && this.picture.camera.near[1] < 0.99999;
  }
  // (z, r) to pixels of the canvas, of the upper half or the lower one: the plane as the camera sees it.
  place(pen, side) {
    const {camera, ratio} = this.picture, {axis} = this.section, zero = camera.project([axis, 0, 0]);
    const [z, x] = [camera.project([axis, 0, 1]), camera.project([axis + side, 0, 0])].map(end => end.map((v, k) => (v - zero[k]) * ratio));
    pen.setTransform(z[0], z[1], x[0], x[1], zero[0] * ratio, zero[1] * ratio);
  }
  // What of it can be measured at a place of the screen, and how far about.
  measured(x, y, within) {
    const {camera} = this.picture, under = this.rims.under(camera, x, y);
    const found = under ? this.rims.near(under, within / camera.zoom) : [];
    return {hit: found.length && found[0].at, found};
  }
  halves(pen, act) {
    const wide = 1e4;
    for (const side of [1, -1]) {
      pen.save();
      this.place(pen, side);
      pen.beginPath();
      pen.rect(-wide, 0, 2 * wide, wide);
      pen.clip();
      act(pen);
      pen.restore();
    }
  }
  fresh(pen) {  // the bar, hatched
    const {colours, camera} = this.picture, {bar, radius} = this, zs = this.section.bar.flat().map(([z]) => z);
    const [low, high] = [Math.min(...zs), Math.max(...zs)], gap = 9 / camera.zoom;
    this.halves(pen, () => {
      pen.fillStyle = colours.metal;
      pen.fill(bar);
      pen.clip(bar);
      pen.strokeStyle = colours.deep;
      pen.lineWidth = 0.8 / camera.zoom;
      pen.beginPath();
      for (let z = low - radius; z < high; z += gap) {
        pen.moveTo(z, 0);
        pen.lineTo(z + radius, radius);
      }
      pen.stroke();
    });
  }
  take(pen, from, to) {
    const {camera, colours} = this.picture;
    this.halves(pen, () => {
      for (let k = from; k < to; k++) {
        pen.globalCompositeOperation = "destination-out";
        pen.fill(this.areas[k]);
        if (!this.crashed.has(this.rows[k])) continue;
        pen.globalCompositeOperation = "source-atop";  // the wound of a rapid keeps a red rim
        pen.strokeStyle = colours.crash;
        pen.lineWidth = 6 / camera.zoom;
        pen.stroke(this.areas[k]);
      }
    });
  }
  // Bring the layer to so many areas, from itself or from the nearest one that was kept.
  bring(count) {
    const {camera, ratio, colours} = this.picture, {layer, canvas} = this;
    const key = [camera.zoom, camera.yaw, camera.pitch, ...camera.target, canvas.width, canvas.height, ratio, colours.metal].join();
    if (key !== this.key) [this.key, this.kept, this.done] = [key, [], -1];
    const pen = layer.getContext("2d");
    if (this.done < 0 || count < this.done) {
      [layer.width, layer.height] = [canvas.width, canvas.height];
      this.kept = this.kept.filter(([done]) => done <= count);
      const last = this.kept[this.kept.length - 1];
      if (last) pen.drawImage(last[1], 0, 0); else this.fresh(pen);
      this.done = last ? last[0] : 0;
    }
    while (this.done < count) {
      const next = Math.min(count, (Math.floor(this.done / EVERY) + 1) * EVERY);
      this.take(pen, this.done, next);
      this.done = next;
      if (next % EVERY === 0 && this.kept.length < LAYERS) this.kept.push([next, copyOf(layer)]);
    }
  }
  draw(rows, share, row) {
    const {canvas, picture} = this, {camera, ratio} = picture;
    if (!picture.part) return true;
    const [w, h] = camera.size.map(size => size * ratio);
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    const count = last(this.rows, rows - 1) + 1;
    if (this.inSpace) this.body.draw(...this.upTo(count, row, share)); else this.bring(count);
    const pen = canvas.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, w, h);
    pen.drawImage(this.inSpace ? this.body.canvas : this.layer, 0, 0);
    if (this.inSpace) return true;
    if (share > 0 && row >= 0) this.begun(pen, row, share);
    this.chuck(pen);
    return true;
  }
  // How many areas are gone, and the outlines of what the row going on has taken so far: of a thread some rings, else the
  // cutting part on its way.
  upTo(count, row, share) {
    const to = last(this.rows, row) + 1, own = to - count - this.section.fallen.filter(k => k >= count && k < to).length;
    if (!(share > 0 && row >= 0 && own > 0) || !this.cuts.value(row)) return [count, []];
    if (own > 2) return [count + Math.floor(own * share), []];
    const {path} = this.run, {axis, blades} = this.section, blade = blades[this.which.value(row)];
    const steps = path.arc[row] < 0 ? 1 : Math.max(1, Math.ceil(Math.abs(path.sweep[path.arc[row]]) * share * 12));
    return [count, Array.from({length: steps}, (_, k) => {
      const corners = hull([k, k + 1].flatMap(i => {
        const [x, , z] = path.point(row, share * i / steps);
        return blade.map(([dz, dr]) => [z + dz, x - axis + dr]);
      }));
      return {z: corners.map(([z]) => z), r: corners.map(([, r]) => r)};
    })];
  }
  begun(pen, row, share) {
    const from = last(this.rows, row - 1) + 1, [to, rings] = this.upTo(from, row, share);
    this.take(pen, from, to);
    this.halves(pen, () => {
      pen.globalCompositeOperation = "destination-out";
      for (const {z, r} of rings) pen.fill(outline(z.map((each, k) => [each, r[k]])));
    });
  }
  chuck(pen) {
    const {camera, colours} = this.picture;
    for (const corners of this.section.chuck) {
      const body = outline(corners);
      this.halves(pen, () => {
        pen.fillStyle = colours.chuck;
        pen.strokeStyle = colours.edge;
        pen.lineWidth = 1.2 / camera.zoom;
        pen.fill(body);
        pen.stroke(body);
      });
    }
  }
}

function outline(corners) {
  const path = new Path2D();
  corners.forEach(([z, r], k) => path[k ? "lineTo" : "moveTo"](z, r));
  path.closePath();
  return path;
}

function copyOf(canvas) {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  copy.getContext("2d").drawImage(canvas, 0, 0);
  return copy;
}
