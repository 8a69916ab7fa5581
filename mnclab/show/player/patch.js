// What of a picture in space is to be drawn anew. Where the processor draws, that is only what changed since it was drawn last,
// and of very many lines only some while the picture turns.

const MARGIN = 4;  // pixels about what changed
const NEAR = 3;  // pixels, up to which steps of a path are one line while it turns
const MOST_PIXELS = 40_000;  // of all lines while it turns

class Patch {
  constructor(picture) {
    this.picture = picture;
  }
  begin(whole, few) {
    const [w, h] = this.picture.camera.size;
    Object.assign(this, {whole, few, box: whole ? [0, 0, w, h] : [Infinity, Infinity, -Infinity, -Infinity]});
  }
  get empty() {
    const [w, h] = this.picture.camera.size, [left, top, right, bottom] = this.box;
    return left > right || right < 0 || bottom < 0 || left > w || top > h;
  }
  add(x, y) {
    const {box} = this;
    if (x - MARGIN < box[0]) box[0] = x - MARGIN;
    if (y - MARGIN < box[1]) box[1] = y - MARGIN;
    if (x + MARGIN > box[2]) box[2] = x + MARGIN;
    if (y + MARGIN > box[3]) box[3] = y + MARGIN;
  }
  addBox(low, high) {
    if (!this.whole) for (const corner of this.corners(low, high)) this.add(...corner);
  }
  addLines({sx, sy}, from, to) {
    if (!this.whole) for (let k = Math.min(from, to); k <= Math.max(from, to); k++) this.add(sx[k], sy[k]);
  }
  corners(...ends) {
    return [0, 1, 2, 3, 4, 5, 6, 7].map(n => this.picture.camera.project([0, 1, 2].map(axis => ends[n >> axis & 1][axis])));
  }
  // Whether a box in space may be seen in it.
  meets(low, high) {
    if (this.whole) return true;
    const corners = this.corners(low, high), [left, top, right, bottom] = this.box;
    return corners.some(([x]) => x >= left) && corners.some(([x]) => x <= right) && corners.some(([, y]) => y >= top) && corners.some(([, y]) => y <= bottom);
  }
  // Draw nothing but it on a canvas.
  clip(gl, {width, height}) {
    const scale = width / this.picture.camera.size[0], [left, top, right, bottom] = this.box.map((v, k) => (k < 2 ? Math.floor : Math.ceil)(v * scale));
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(left, height - bottom, right - left, bottom - top);
  }
  // The lines between two points of a path that are to be drawn, as pairs of the first and last line of each; null: all of them.
  lines({sx, sy}, kinds, from, to, hair) {
    if (this.whole) return this.few ? this.fewLines(sx, sy, kinds, from, to, hair) : null;
    const found = [], [left, top, right, bottom] = this.box;
    for (let k = from; k < to; k++) {
      const ax = sx[k], ay = sy[k], bx = sx[k + 1], by = sy[k + 1];
      if ((ax < left && bx < left) || (ax > right && bx > right) || (ay < top && by < top) || (ay > bottom && by > bottom)) continue;
      const dx = bx - ax, dy = by - ay, beside = dx * ay - dy * ax, one = dx * top - dy * left > beside;
      if ((dx * top - dy * right > beside) === one && (dx * bottom - dy * left > beside) === one && (dx * bottom - dy * right > beside) === one && (dx || dy)) continue;
      found.push(k, k);
    }
    return found;
  }
  fewLines(sx, sy, kinds, from, to, hair) {
    const found = [];
    let pixels = 0;
    for (let k = from; k < to; k++) {
      const first = k, away = n => Math.abs(sx[n] - sx[first]) + Math.abs(sy[n] - sy[first]);
      while (hair && k + 1 < to && kinds[k + 2] === kinds[first + 1] && away(k + 2) < NEAR) k++;
      found.push(first, k);
      pixels += away(k + 1);
    }
    const apart = Math.ceil(pixels / MOST_PIXELS);
    return apart > 1 ? found.filter((_, k) => (k >> 1) % apart === 0) : found;
  }
}
