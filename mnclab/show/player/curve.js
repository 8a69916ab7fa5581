// Speed over time, with the slider of the time lying upon it. The scale ends at the fastest cut: rapids are cut off.

const SCALE = 14;  // pixels above the curve for the words of its scale

class Curve {
  constructor(canvas, run) {
    this.canvas = canvas;
    this.run = run;
    const {course, path} = run;
    let cuts = 0, all = 0;
    for (let i = 0; i < course.n; i++) {
      const top = run.over(course.row[i], Math.max(course.v[i], course.v[i + 1]));
      all = Math.max(all, top);
      if (path.kind[course.row[i]] !== RAPID) cuts = Math.max(cuts, top);
    }
    this.most = (cuts || all) * 1.08 || 1;
    this.moves = all > 0;
    this.clipped = all > this.most;
  }
  draw(colours) {
    const {canvas, run} = this, box = canvas.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
    const w = Math.round(box.width), h = Math.round(box.height), {course, path} = run, total = run.time || 1;
    if (!w) return;
    canvas.width = w * ratio;
    canvas.height = h * ratio;
    const pen = canvas.getContext("2d"), foot = h - 0.5, lift = h - (this.moves ? SCALE : 4);
    pen.scale(ratio, ratio);
    for (const [colour, rapid] of [[colours.rapid, true], [colours.cut, false]]) {
      const top = new Float32Array(w + 1).fill(-1);  // the greatest speed in every column of pixels
      const note = (x, v) => { if (v > top[x]) top[x] = v; };
      for (let i = 0; i < course.n; i++) {
        if ((path.kind[course.row[i]] === RAPID) !== rapid) continue;
        const a = course.t[i] / total * w, b = course.t[i + 1] / total * w, from = Math.floor(a), to = Math.min(w, Math.ceil(b));
        const [before, behind] = [course.v[i], course.v[i + 1]].map(v => run.over(course.row[i], v));
        note(from, before);
        note(Math.min(w, Math.floor(b)), behind);
        for (let x = from + 1; x < to; x++) {
          const u = (x - a) / (b - a);
          note(x, before + u * (behind - before));
        }
      }
      pen.strokeStyle = pen.fillStyle = colour;
      pen.beginPath();
      for (let x = 0; x <= w; x++) {
        if (top[x] < 0) continue;
        const y = foot - Math.min(top[x] / this.most, 1) * lift, next = x < w && top[x + 1] >= 0;
        if (x === 0 || top[x - 1] < 0) pen.moveTo(x, foot);
        pen.lineTo(x, y);
        if (!next) pen.lineTo(x + 0.6, foot);
      }
      pen.globalAlpha = 0.16;
      pen.fill();
      pen.globalAlpha = 1;
      pen.lineWidth = 1.1;
      pen.stroke();
    }
    pen.fillStyle = colours.alarm;  // where something collides: a wedge at the upper edge
    for (const {row} of this.run.header.collisions) {
      if (row < 0) continue;  // before the first one
      const x = this.run.begin[this.run.itemOfRow[row]] / total * w;
      trace(pen, [[x - 4, 0], [x + 4, 0], [x, 8]]);
      pen.fill();
      pen.fillRect(x - 0.5, 0, 1, h);
    }
    pen.fillStyle = colours.now;  // where the playing stops: at the lower edge
    for (const {t} of this.stops ? this.stops.all : []) pen.fillRect(t / total * w - 1, h - 9, 2, 9);
    if (!this.moves) return;  // no scale of nothing
    pen.font = "10px system-ui, sans-serif";
    pen.textBaseline = "top";
    const text = `${number(this.most / 1.08 * 60 / this.run.unit.length, this.run.unit.length > 1 ? 1 : 0)} ${this.run.unit.short}/min${this.clipped ? ", rapids go beyond" : ""}`;
    pen.fillStyle = colours.paper;
    pen.globalAlpha = 0.8;
    pen.fillRect(3, 0, pen.measureText(text).width + 6, 12);
    pen.globalAlpha = 1;
    pen.fillStyle = colours.quiet;
    pen.fillText(text, 6, 1);
  }
}
