// The part in the picture: cut to where the playing stands, then drawn as a relief, or from above where there is no WebGL.

const SLICE = 9;  // ms of a frame that cutting may take
const COARSE = 0.5;  // of the pixels along a side, while the picture turns, or plays slowly, and the processor draws

class ShownPart {
  constructor(canvas, run, picture) {
    this.canvas = canvas;
    this.picture = picture;
    this.carving = new Carving(run);
    this.surface = new Surface(this.carving);
    const relief = new Relief(canvas, this.carving, picture);
    this.drawing = relief.gl ? relief : new Shaded(canvas, this.carving);
    this.inSpace = Boolean(relief.gl);  // path and tool are drawn with the part
    this.note = [run.header.part.note, relief.gl ? "" : "without WebGL: the part is shown from above only"].filter(Boolean).join("; ");
    this.scouted = () => {};  // what is to be done when all is cut ahead
    this.scout();
  }
  // True once the part is cut to there.
  draw(rows, share, row, turning = false, late = false) {
    const {canvas, picture, carving} = this, {camera, ratio, colours} = picture;
    if (!picture.part) return true;
    const [w, h] = camera.size.map(size => Math.round(size * ratio * ((turning || late) && this.drawing.slow ? COARSE : 1)));
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    carving.aim(rows, share);
    const there = carving.work(performance.now() + SLICE);
    this.drawing.draw(camera, colours, carving.map, row, ratio, turning);
    return there;
  }
  // What of it can be measured at a place of the screen, at most so many pixels beside, and whether a place is in sight. An
  // edge is also found from the side on which one looks past it.
  measured(x, y, within) {
    const {surface, picture: {camera}} = this, reach = within / camera.zoom;
    if (this.drawing instanceof Shaded && camera.near[2] < 0.99999) return {found: []};
    const aside = 0.7 * within, hits = [[0, 0], [aside, 0], [-aside, 0], [0, aside], [0, -aside]]
      .map(([dx, dy]) => surface.hit(camera, x + dx, y + dy)), own = hits[0], some = hits.filter(Boolean);
    surface.look(some.map(({at}) => at), reach);
    const found = some.flatMap(hit => surface.near(hit, reach).filter(each => hit === own || each.cost !== FREE));
    return {hit: own && own.at, found, sees: at => this.sees(at)};
  }
  sees(at) {  // whether no metal stands before a place
    const {surface, picture: {camera}} = this, front = surface.hit(camera, ...camera.project(at));
    return !front || front.at.reduce((sum, v, k) => sum + (v - at[k]) * camera.near[k], 0) < 4 * surface.grid.step;
  }
  // Cut ahead while the page has nothing else to do.
  scout() {
    const idle = window.requestIdleCallback || (act => setTimeout(() => act({timeRemaining: () => 5}), 20));
    idle(time => this.carving.ahead(performance.now() + Math.min(time.timeRemaining(), SLICE)) ? this.scouted() : this.scout());
  }
}
