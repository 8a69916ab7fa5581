// A turned part in space: the body of its section, a quarter of it taken out where one looks at the tool, in its chuck.

const CUT_OUT = Math.PI / 2;  // from the half plane of the tool on
const JAWS = [[-Math.PI / 6, 0], [CUT_OUT, CUT_OUT + Math.PI / 3], [CUT_OUT + 2 * Math.PI / 3, 2 * CUT_OUT + Math.PI / 2]];
const SKIN = 1e-3;  // mm off the bar, within which its skin is still there
const MOST_STATES = 32, BETWEEN = 200;  // of the section that are kept to go back from, and areas between them

class TurnedBody {
  constructor(shown) {
    const {run, picture, section, rings} = shown, canvas = document.createElement("canvas"), slow = drawnByProcessor();
    Object.assign(this, {shown, run, picture, section, canvas, slow, gl: canvas.getContext("webgl2", {antialias: !slow}), version: 0});
    if (!this.gl) return;
    canvas.addEventListener("webglcontextlost", event => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.prepare());
    const bar = rings.slice(shown.areas.length), zs = rings.flatMap(({z}) => [...z]);
    this.bar = new Columns(zs).fill(bar);
    this.states = [[0, this.bar]];
    this.held = section.chuck.map(corners => new Columns(corners.map(([z]) => z)).fill([{z: corners.map(([z]) => z), r: corners.map(([, r]) => r)}]));
    this.prepare();
  }
  prepare() {
    this.beside = new Beside(this.gl, this.run, this.picture);
  }
  // The section after so many areas.
  after(count) {
    let [done, columns] = this.states.filter(([n]) => n <= count).pop();
    if (done === count) return columns;
    columns = columns.copy();
    for (; done < count; done++) {
      if (done % BETWEEN === 0 && done > this.states[this.states.length - 1][0] && this.states.length < MOST_STATES) this.states.push([done, columns.copy()]);
      columns.take(this.shown.rings[done]);
    }
    return columns;
  }
  draw(count, begun) {
    const {gl, canvas, picture: {camera, colours, ratio}, beside: {space}} = this, [w, h] = camera.size.map(size => Math.round(size * ratio));
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    space.look(camera, this.beside.far(camera), ratio);
    this.part(count, begun, rgb(colours.raw), rgb(colours.metal), rgb(colours.deep));
    this.section.chuck.forEach((_, k) => this.chuck(k, rgb(colours.chuck)));
    this.beside.draw();
  }
  part(count, begun, raw, metal, deep) {
    const {beside: {space}, bar, section: {axis}, picture: {camera}} = this, key = `${count} ${begun.length ? ++this.version : ""}`;
    let columns = null, sides = null;
    const now = () => {
      if (columns) return columns;
      columns = this.after(count);
      if (begun.length) columns = columns.copy();
      begun.forEach(ring => columns.take(ring));
      return columns;
    };
    const kind = (r, k) => bar.pieces[k].some(edge => Math.abs(edge - r) < SKIN) ? 0 : 1;
    const turned = what => revolved((sides ||= now().sides(kind)).filter(each => each.kind === what).map(({side}) => side), 2, CUT_OUT, 2 * Math.PI - CUT_OUT, [axis, 0, 0]);
    space.fill(space.body("skin", () => turned(0), key), raw);
    space.fill(space.body("turned", () => turned(1), key), metal);
    const open = space.body("open", () => [...now().flat(0, 1, axis), ...now().flat(CUT_OUT, -1, axis)], key);
    space.fill(open, metal, {stripe: deep, gap: 9 / camera.zoom});
  }
  chuck(k, tone) {  // what is less wide than its body are the jaws
    const {beside: {space}, held, section: {axis}} = this, columns = held[k], wide = Math.max(...columns.pieces.flat());
    const whole = columns.only(piece => piece.length && piece[piece.length - 1] > wide - SKIN), jaws = columns.only(piece => piece.length && piece[piece.length - 1] <= wide - SKIN);
    const body = (part, from, turn) => [...revolved(part.sides(() => 0).map(({side}) => side), 2, from, turn, [axis, 0, 0]),
      ...part.flat(from, -1, axis), ...part.flat(from + turn, 1, axis)];
    space.fill(space.body(`chuck ${k}`, () => body(whole, CUT_OUT, 2 * Math.PI - CUT_OUT)), tone);
    space.fill(space.body(`jaws ${k}`, () => JAWS.flatMap(([from, to]) => body(jaws, from, to - from))), tone);
  }
}
