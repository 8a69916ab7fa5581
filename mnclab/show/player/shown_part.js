// The part in the picture: cut to where the playing stands, then drawn as a relief, or from above where there is no WebGL.

const SLICE = 9;  // ms of a frame that cutting may take
const REST = 250;  // ms after which a picture stands

class ShownPart {
  constructor(canvas, run, picture) {
    this.canvas = canvas;
    this.picture = picture;
    this.drawn = -Infinity;
    this.carving = new Carving(run);
    const relief = new Relief(canvas, this.carving);
    this.drawing = relief.gl ? relief : new Shaded(canvas, this.carving);
    this.note = [run.header.part.note, relief.gl ? "" : "without WebGL: the part is shown from above only"].filter(Boolean).join("; ");
    this.scout();
  }
  show(on) {
    this.picture.part = on ? this : null;
    this.canvas.hidden = !on;
  }
  // True once the part is cut to there.
  draw(rows, share, row) {
    const {canvas, picture, carving} = this, {camera, ratio, colours} = picture;
    if (!picture.part) return true;
    const [w, h] = camera.size.map(size => size * ratio);
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    carving.aim(rows, share);
    const there = carving.work(performance.now() + SLICE);
    const now = performance.now(), draw = moving => this.drawing.draw(camera, colours, carving.map, row, ratio, moving);
    draw(now - this.drawn < REST);
    this.drawn = now;
    clearTimeout(this.rest);
    if (this.drawing.slow) this.rest = setTimeout(() => draw(false), REST);
    return there;
  }
  // Cut ahead while the page has nothing else to do.
  scout() {
    const idle = window.requestIdleCallback || (act => setTimeout(() => act({timeRemaining: () => 5}), 20));
    idle(time => this.carving.ahead(performance.now() + Math.min(time.timeRemaining(), SLICE)) || this.scout());
  }
}
