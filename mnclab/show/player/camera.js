// An orthographic camera on a turntable: directions of the screen in space, a place it looks at, pixels a millimetre.

const VIEWS = {  // yaw and pitch in degrees
  top: [0, 90], front: [0, 0], right: [90, 0], isometric: [30, 28],
};

class Camera {
  constructor(lathe) {
    this.lathe = lathe;  // Z to the right, X up
    this.target = [0, 0, 0];
    this.zoom = 1;
    this.size = [1, 1];
    this.turned = way => way;  // with a part that it goes with
    this.turnTo(lathe ? "front" : "isometric");
  }
  turnTo(name) {
    [this.yaw, this.pitch] = VIEWS[name];
    this.name = name;
    this.update();
  }
  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.min(90, Math.max(-90, this.pitch + pitch));
    this.name = "";
    this.update();
  }
  update() {
    const y = this.yaw * Math.PI / 180, p = this.pitch * Math.PI / 180;
    const lies = ([a, b, c]) => this.turned(this.lathe ? [c, -b, a] : [a, b, c]);  // screen-up is Z, on a lathe X
    this.right = lies([Math.cos(y), Math.sin(y), 0]);
    this.up = lies([-Math.sin(y) * Math.sin(p), Math.cos(y) * Math.sin(p), Math.cos(p)]);
    this.near = lies([Math.sin(y) * Math.cos(p), -Math.cos(y) * Math.cos(p), Math.sin(p)]);
  }
  project(point) {
    const x = point[0] - this.target[0], y = point[1] - this.target[1], z = point[2] - this.target[2];
    const {right: r, up: u} = this;
    return [
      this.size[0] / 2 + this.zoom * (x * r[0] + y * r[1] + z * r[2]),
      this.size[1] / 2 - this.zoom * (x * u[0] + y * u[1] + z * u[2]),
    ];
  }
  // A point that lies at a place of the screen, at the depth of the target.
  unproject(x, y) {
    const dx = (x - this.size[0] / 2) / this.zoom, dy = (this.size[1] / 2 - y) / this.zoom;
    return this.target.map((t, k) => t + dx * this.right[k] + dy * this.up[k]);
  }
  pan(dx, dy) {
    this.target = this.target.map((t, k) => t - (dx * this.right[k] - dy * this.up[k]) / this.zoom);
  }
  zoomAt(factor, x = this.size[0] / 2, y = this.size[1] / 2) {
    const dx = x - this.size[0] / 2, dy = y - this.size[1] / 2;
    this.pan(-dx, -dy);
    this.zoom = Math.min(1e5, Math.max(1e-4, this.zoom * factor));
    this.pan(dx, dy);
  }
  // The whole of something in the picture, with room at the borders for the rulers: `reach` says from where to where it lies
  // along a direction.
  fit(reach) {
    const spans = [this.right, this.up, this.near].map(reach), [across, upwards] = spans.map(([low, high]) => high - low > 1e-4 ? high - low : 0);
    const middle = spans.map(([low, high]) => (low + high) / 2);
    this.target = [0, 1, 2].map(k => middle[0] * this.right[k] + middle[1] * this.up[k] + middle[2] * this.near[k]);
    const [w, h] = this.size, [beside, above] = this.along(this.right) && this.along(this.up) ? [108, 60] : [40, 44];
    this.zoom = across || upwards ? Math.min((w - beside) / across, (h - above) / upwards) : 400;
    if (!(this.zoom > 0)) this.zoom = 1;
  }
  // The axis (0, 1, 2) that a direction of the screen lies along, and its sense; null if it is none.
  along(direction) {
    const k = direction.findIndex(value => Math.abs(value) > 0.99999);
    return k < 0 ? null : [k, Math.sign(direction[k])];
  }
}
