// Two clicks measure. A found place is {what, at, off, round}: its name, the point, how exact it is where it is not (mm), and
// of a round wall or an arc {d, centre, off}, of a straight edge its direction `along` in the plane.

const SNAP = 12, FINGER = 22;  // pixels about the pointer that are looked at

class Measure {
  constructor(page) {
    const {find, run, picture} = page;
    Object.assign(this, {page, find, run, picture, camera: picture.camera, on: false, points: [], hover: null, pointer: null});
    this.path = new PathPoints(run, picture.strokes, picture.camera);
    this.canvas = find("picture");
    this.canvas.addEventListener("pointermove", event => {
      if (!this.on || event.buttons || event.pointerType === "touch" || this.waiting) return;
      this.waiting = requestAnimationFrame(() => {
        this.waiting = 0;
        this.point(event.offsetX, event.offsetY);
      });
    });
    this.canvas.addEventListener("pointerleave", () => this.point());
    find("measure").addEventListener("click", () => this.turn());
    find("copy").addEventListener("click", () => this.copy());
    this.write();
  }
  turn(on = !this.on) {
    this.on = on;
    this.points = [];
    this.find("measure").setAttribute("aria-pressed", on);
    for (const [id, shown] of [["measured", on], ["marks", on], ["modal", !on]]) this.find(id).toggleAttribute("hidden", !shown);
    for (const id of ["picture", "measured"]) this.find(id).parentElement.classList.toggle("measuring", on);
    if (on) this.canvas.focus();
    this.point();
    this.write();
  }
  escape() {  // first the points, then the mode
    if (!this.points.length) return this.turn(false);
    this.points = [];
    this.write();
    this.draw();
  }
  // The place that is meant; of those nearly equally near the one nearest to the surface there, else to the eye; of circles that
  // touch there the larger one.
  place(x, y, finger) {
    const within = finger ? FINGER : SNAP, {camera, picture} = this, near = camera.near;
    const {hit, found, sees} = picture.part ? picture.part.measured(x, y, within) : {found: []};
    if (!hit) found.push(...this.path.on(x, y, within, picture.rapids));
    for (const each of this.path.near(x, y, hit ? within / 2 : within, picture.rapids)) found.push({...each, cost: each.cost + (hit ? 2 : 0)});  // the part first
    const ranked = found.map(each => {
      const [px, py] = camera.project(each.at), away = Math.hypot(px - x, py - y);
      const behind = each.at.reduce((sum, v, k) => sum + (hit ? Math.abs(v - hit[k]) : -v * near[k]), 0);
      return {each, away, score: away * SNAP / within + each.cost + Math.atan(behind) / 10 + (each.round ? 0.3 / each.round.d : 0)};
    }).filter(({away, each}) => away <= within || each.cost === FREE);
    const best = ranked.sort((a, b) => a.score - b.score).find(({each}) => !sees || sees(each.at));
    return best ? best.each : null;
  }
  point(x, y) {
    this.pointer = x === undefined ? null : [x, y];
    this.hover = this.on && this.pointer ? this.place(x, y) : null;
    if (this.hover && this.points.some(({at}) => at.every((v, k) => v === this.hover.at[k]))) this.hover = null;
    this.draw();
  }
  click(x, y, finger) {
    const found = this.place(x, y, finger);
    this.point();
    if (!found) return this.page.tell("nothing to measure there");
    this.points = this.points.length === 1 ? [...this.points, found] : [found];
    this.write();
    this.draw();
    this.said([this.text(found), this.points.length > 1 ? this.summary() : ""].filter(Boolean).join("; "));
  }
  said(text) {
    this.find("said").textContent = text;
  }
  // By keys: a pointer that the arrows move, and Enter.
  key(key, fine) {
    const step = fine ? 1 : 10, moves = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
    const [x, y] = this.pointer || this.camera.size.map(size => size / 2);
    if (key === "Enter") this.click(x, y);
    else if (!moves[key]) return false;
    const [w, h] = this.camera.size, [dx, dy] = moves[key] || [0, 0];
    this.point(Math.min(Math.max(x + dx, 0), w - 1), Math.min(Math.max(y + dy, 0), h - 1));
    return true;
  }

  // --- what is written ------------------------------------------------------------------------------------------------

  columns(at) {  // in the unit of the program
    return (this.run.lathe ? [2 * Math.abs(at[0]), at[0], at[2]] : at).map(value => value / this.run.unit.length);
  }
  length(mm) {
    return number(mm / this.run.unit.length, this.run.unit.decimals);
  }
  text({what, at, off, round}) {
    const names = this.run.lathe ? ["⌀", "radius", "Z"] : ["X", "Y", "Z"];
    return `${what} ${this.columns(at).map((v, k) => `${names[k]} ${number(v, this.run.unit.decimals)}`).join(" ")}${this.doubt(off)}${round ? ", " + this.round(round) : ""}`;
  }
  doubt(off) {
    return off ? ` ± ${lengthText(off, this.run.unit.length)}` : "";
  }
  round({d, centre, off, path}) {
    const {lathe, unit} = this.run, size = lathe ? `R ${this.length(d / 2)}` : `⌀ ${this.length(d)}`;
    const at = this.columns(centre).map(value => number(value, unit.decimals));
    const about = lathe ? `⌀ ${at[0]} Z ${at[2]}` : `X ${at[0]} Y ${at[1]}`;
    return `${size}${this.doubt(off)}${path ? " of the path" : ""}, centre ${about}`;
  }
  summary() {
    const [a, b] = this.points, unit = this.run.unit.short, apart = (p, q) => this.length(Math.hypot(...p.map((v, k) => q[k] - v))), off = (a.off || 0) + (b.off || 0);
    const flat = ([x, y, z]) => this.run.lathe ? [x, z] : [x, y];
    const text = `distance ${apart(a.at, b.at)}${this.doubt(off)} ${unit}`;
    if (a.round && b.round) return `${text}, centres ${apart(flat(a.round.centre), flat(b.round.centre))} ${unit} apart`;
    const gap = this.gap(), angle = this.angle();
    if (angle) return `${text}, ${angle}° between the edges`;
    return gap && gap !== apart(a.at, b.at) ? `${text}, ${gap} ${unit} between the edges` : text;
  }
  angle() {  // between two straight edges that are not parallel
    const [{along: a}, {along: b}] = this.points, turn = a && b ? Math.abs(a[0] * b[1] - a[1] * b[0]) : 0;
    return turn > 1e-6 ? short(Math.atan2(turn, Math.abs(a[0] * b[0] + a[1] * b[1])) * 180 / Math.PI) : "";
  }
  gap() {  // between two straight edges that are parallel in the plane
    const [a, b] = this.points, [dx, dy] = [0, this.run.lathe ? 2 : 1].map(k => b.at[k] - a.at[k]);
    if (!a.along || !b.along || Math.abs(a.along[0] * b.along[1] - a.along[1] * b.along[0]) > 1e-6) return "";
    const gap = Math.abs(dx * a.along[1] - dy * a.along[0]);
    return gap > 1e-6 ? this.length(gap) : "";
  }
  write() {
    const {points, run} = this, [a, b] = points.map(({at}) => this.columns(at));
    const rows = [[run.unit.short, ...run.lathe ? ["⌀", "radius", "Z"] : ["X", "Y", "Z"], points.length ? "" : "click on two places of the part or of the path"]];
    points.forEach(({what, at, off, round}, k) => rows.push([`${k + 1}`, ...this.columns(at).map(v => number(v, run.unit.decimals)),
      `${what}${this.doubt(off)}${round ? `, ${this.round(round)}` : ""}`]));
    if (b) rows.push(["Δ", ...b.map((v, k) => number(v - a[k], run.unit.decimals)), this.summary()]);
    this.find("values").replaceChildren(...rows.map((row, i) => made("tr", {}, ...row.map((text, k) =>
      i && k ? made("td", {}, text) : made("th", {scope: i ? "row" : "col"}, text)))));
    this.find("copy").hidden = !points.length;
  }
  copy() {  // a frame of a notebook may not ask for the clipboard, but copy what is selected
    const selection = getSelection();
    selection.selectAllChildren(this.find("values"));
    this.said(document.execCommand("copy") ? "copied" : "select the values and copy them");
    selection.removeAllRanges();
  }

  // --- what is drawn --------------------------------------------------------------------------------------------------

  draw() {
    const {on, points, hover, pointer, camera} = this, marks = [];
    if (!on) return;
    const add = (name, kind, values, text = "") => {
      const mark = document.createElementNS(this.find("marks").namespaceURI, name);
      mark.setAttribute("class", kind);
      for (const [key, value] of Object.entries(values)) mark.setAttribute(key, value);
      mark.textContent = text;
      marks.push(mark);
    };
    const line = (kind, d) => ["halo", kind].forEach(each => add("path", each, {d}));
    const cross = (kind, [x, y], size) => line(kind, `M${x - size} ${y - size}l${2 * size} ${2 * size}m0 ${-2 * size}l${-2 * size} ${2 * size}`);
    const places = points.map(({at}) => camera.project(at));
    if (pointer && !hover && !points.length) cross("aim", pointer, 5);
    [...points, hover].filter(each => each && each.round).forEach(({round}) => this.ring(round, line));
    if (places.length > 1) line("between", `M${places.join("L")}`);
    places.forEach((place, k) => {
      cross("mark", place, 6);
      add("text", "", {x: place[0] + 9, y: place[1] - 8}, `${k + 1}`);
    });
    if (places.length > 1) this.lengths(places, add);
    if (hover) {
      const place = camera.project(hover.at), right = place[0] > camera.size[0] - 150;
      cross("aim", place, 7);
      add("text", right ? "left" : "", {x: place[0] + (right ? -12 : 12), y: place[1] + 20}, hover.round ? `${hover.what} ${this.round(hover.round).split(",")[0]}` : hover.what);
    }
    this.find("marks").replaceChildren(...marks);
  }
  lengths([[ax, ay], [bx, by]], add) {  // at the middle of the line, or below it where it is short
    const long = Math.hypot(bx - ax, by - ay) > 110, x = Math.min(Math.max((ax + bx) / 2, 90), this.camera.size[0] - 90);
    const y = Math.min((long ? (ay + by) / 2 : Math.max(ay, by) + 8) + 16, this.camera.size[1] - 28);
    this.summary().split(", ").forEach((text, k) => add("text", k ? "more" : "length", {x, y: y + 16 * k}, text.replace(/^distance| (mm|in)\b/g, "").trim()));
  }
  ring({d, centre}, line) {
    const [a, b] = this.run.lathe ? [0, 2] : [0, 1], places = [];
    for (let k = 0; k <= 72; k++) {
      const at = centre.slice(), angle = 2 * Math.PI * k / 72;
      at[a] += d / 2 * Math.cos(angle);
      at[b] += d / 2 * Math.sin(angle);
      places.push(this.camera.project(at));
    }
    const [x, y] = this.camera.project(centre);
    line("ring", `M${places.join("L")}M${x - 6} ${y}h12m-6 -6v12`);
  }
}
