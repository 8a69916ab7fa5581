// The part from above without WebGL: an image of the cells, shaded by their slopes. Other views do not have it.

class Shaded {
  constructor(canvas, carving) {
    const {nx, ny} = carving.grid;
    this.canvas = canvas;
    this.grid = carving.grid;
    this.depths = carving.depths;
    this.image = document.createElement("canvas");
    [this.image.width, this.image.height] = [nx, ny];
    this.data = this.image.getContext("2d").createImageData(nx, ny);
    this.sent = [];
    this.row = -1;
    this.colours = null;
  }
  draw(camera, colours, map, row, ratio) {
    const pen = this.canvas.getContext("2d"), {grid} = this;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    if (camera.near[2] < 0.99999) return;
    this.paint(map, row, colours);
    const [x0, y0] = camera.project([...grid.low, 0]);
    const turn = Math.atan2(-camera.right[1], camera.right[0]), scale = grid.step * camera.zoom;
    pen.scale(ratio, ratio);
    pen.translate(x0, y0);
    pen.rotate(turn);
    pen.scale(scale, -scale);
    pen.imageSmoothingEnabled = false;
    pen.drawImage(this.image, 0, 0);
  }
  paint(map, row, colours) {
    const {grid, data} = this, {nx} = grid, all = colours !== this.colours || row !== this.row, tones = this.tones(colours);
    if (all) this.sent = [];
    for (const k of map.changed(this.sent).keys()) {
      const i0 = k % grid.across * TILE, j0 = (k / grid.across | 0) * TILE;
      for (let j = j0; j < Math.min(j0 + TILE, grid.ny); j++)
        for (let i = i0; i < Math.min(i0 + TILE, nx); i++) this.pixel(map, i, j, row, tones, data.data, (j * nx + i) * 4);
    }
    [this.colours, this.row] = [colours, row];
    this.image.getContext("2d").putImageData(data, 0, 0);
  }
  tones(colours) {
    return Object.fromEntries(["raw", "metal", "deep", "crash", "now"].map(name => [name, rgb(colours[name])]));
  }
  pixel(map, i, j, row, tones, data, at) {
    const {grid, depths: [low, high]} = this, {height, by} = map.at(i, j), floor = grid.floor[j * grid.nx + i];
    const [dx, dy] = map.slope(i, j), light = 0.5 + 0.5 * (0.45 * dx - 0.6 * dy + 0.9) / Math.hypot(dx, dy, 1) / 1.17;
    const depth = Math.sqrt(Math.min(Math.max((high - height) / Math.max(high - low, 1e-6), 0), 1));
    const tone = by < 0 ? tones.crash : by === 0 ? tones.raw : tones.metal.map((v, k) => v + depth * (tones.deep[k] - v));
    const mixed = by > 0 && by === row + 1 ? tone.map((v, k) => 0.45 * v + 0.55 * tones.now[k]) : tone;
    mixed.forEach((v, k) => { data[at + k] = 255 * v * (0.42 + 0.62 * light * light); });
    data[at + 3] = height > floor ? 255 : 0;
  }
}
