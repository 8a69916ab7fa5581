// The page: where the playing stands, what moves it, and showing it. A *place* is {item, t, done}: an item of the run,
// a time within it, and whether it is behind us; items that take no time are done or not.

const KEYS = [
  ["space", "play and stop"], ["J  K  L", "backwards, stop, forwards"], ["← →", "block by block"], [",  .", "move by move"],
  ["shift ← →", "one second at a time"], ["Home  End", "to the start, to the end"], ["W A S D", "turn the picture"],
  ["+  −  F", "zoom, fit"], ["1 2 3 4", "views"], ["drag", "turns; with shift or two fingers it shifts"],
  ["click", "on a line or on the path goes there; on the number of a line it sets a stop; with shift the run plays up to a line"],
  ["B  N", "a stop at this block; to the next stop, with shift to the one before"], ["wheel", "zooms, once the picture has been clicked"],
  ["R", "rapids, shown or not"], ["C", "what the colour of the cuts says"], ["M", "measures between two clicks (or arrows and enter); Esc clears"],
];
const MACHINE_KEYS = [["T", "the table turns, or the part stands still and the tool goes about it"], ["H", "fit as far as the axes of the head"]];
const PART_KEYS = [["P", "the part, shown or not"]];
const LATE = 40;  // ms from frame to frame, beyond which playing makes do with a coarser picture
const STANDS = 150;  // ms after which a picture that was turned is drawn sharp
const LATHE_KEYS = new Map([["drag", "shifts; with shift it turns"], ["1 2 3 4", "views (three)"]]);

class PlayerPage {
  constructor(run) {
    const find = this.find = id => document.getElementById(id);
    this.run = run;
    this.place = {item: 0, t: 0, done: false};
    this.playing = 0;  // 1 forwards, -1 backwards
    this.turning = false;
    this.stands = 0;
    this.root = document.documentElement;
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    this.theme(this.root.dataset.theme);
    this.picture = new Picture(find("picture"), find("ground"), run);
    const {part, section} = run.header;
    this.part = part ? new ShownPart(find("part"), run, this.picture) : section && new ShownSection(find("part"), run, this.picture);
    this.curve = new Curve(find("curve"), run);
    this.listing = new Listing(find("listing"), run, find("program"), {
      go: (program, line) => this.goLine(program, line), to: (program, line) => this.stops.runTo(program, line),
      stop: (program, line) => this.stops.turn(program, line),
    });
    this.board = new Board(run, find);
    this.shades = this.picture.shades = new Shades(run, part && this.part.carving);
    if (part) this.part.scouted = () => this.shades.name === "engagement" && this.colour("engagement");
    this.measure = new Measure(this);
    this.stops = this.listing.stops = this.curve.stops = new Stops(this);
    this.buttons();
    this.legend();
    this.alarms();
    this.showPart(true);
    this.showMachine(true);
    if (run.header.turning && !part) Object.assign(find("note"), {textContent: "the blank, not cut", hidden: false});
    this.pointers();
    document.addEventListener("keydown", event => this.key(event));
    this.dark.addEventListener("change", () => this.theme(this.root.dataset.theme));
    this.followNotebook();
    this.resize(false);
    new ResizeObserver(() => this.resize()).observe(document.body);
    if (!run.lathe && this.picture.box[1][2] - this.picture.box[0][2] < 1e-6) this.view("top");
    else this.view(run.lathe ? "front" : "isometric");
    this.go(this.place);
  }

  // --- places ---------------------------------------------------------------------------------------------------------

  get atStart() {
    return this.place.item === 0 && !this.place.done && this.place.t <= 0;
  }
  get step() {
    return this.atStart || !this.run.items ? -1 : this.run.itemStep[this.place.item];
  }
  afterItem(item) {
    return item < 0 ? {item: 0, t: 0, done: false} : {item, t: this.run.end[item], done: true};
  }
  afterStep(step) {
    return this.afterItem(step < 0 ? -1 : this.run.first[step + 1] - 1);
  }
  atTime(t) {
    if (t <= 0 || !this.run.items) return this.afterItem(-1);
    if (t >= this.run.time) return this.afterItem(this.run.items - 1);
    return {item: this.run.itemAt(t), t, done: false};
  }
  blockOn() {
    const {step, run} = this, end = this.afterStep(step);
    if (step >= 0 && !(this.place.done && this.place.item === end.item)) return end;
    return this.afterStep(Math.min(step + 1, run.steps - 1));
  }
  blockBack() {
    return this.afterStep(this.step - 1);
  }
  moves(item) {
    return this.run.itemRow[item] >= 0 && this.run.path.isMotion(this.run.itemRow[item]);
  }
  moveOn() {
    let item = this.place.item + (this.place.done ? 1 : 0);
    while (item < this.run.items && !this.moves(item)) item++;
    return this.afterItem(Math.min(item, this.run.items - 1));
  }
  moveBack() {
    let item = this.place.item - 1;
    while (item >= 0 && !this.moves(item)) item--;
    return this.afterItem(item);
  }

  // --- going there ----------------------------------------------------------------------------------------------------

  go(place) {
    this.place = place;
    this.show();
    if (!this.playing) this.say();
  }
  goLine(program, line) {
    this.stop();
    const block = this.run.blockOfLine(program, line);
    if (block < 0) return this.go(this.afterItem(-1));
    const step = this.run.execution(program, block, this.step);
    if (step >= 0) return this.go(this.afterStep(step));
    this.listing.turnTo(program);
    this.listing.reveal(line);
    this.tell(`line ${line} is not executed`);
  }
  tell(text) {
    this.find("said").textContent = this.find("doing").textContent = text;
  }
  nearest(row, away) {  // where on a row the tool is nearest to something
    const {run} = this, item = run.itemOfRow[row], begin = run.begin[item], span = run.end[item] - begin;
    let best = begin, least = Infinity;
    for (let k = 0; k <= 200; k++) {
      const t = begin + span * k / 200, here = away(run.tool(item, t).point);
      if (here < least) [best, least] = [t, here];
    }
    return best >= run.end[item] ? this.afterItem(item) : {item, t: best, done: false};
  }
  goRow(row, x, y) {  // to the point of a row nearest to a place on the screen
    this.stop();
    this.go(this.nearest(row, point => {
      const [px, py] = this.picture.camera.project(point);
      return Math.hypot(px - x, py - y);
    }));
  }
  play(direction) {
    if (this.playing === direction) return this.stop();
    if (direction > 0 && this.place.t >= this.run.time) this.place = this.afterItem(-1);
    if (direction < 0 && this.place.t <= 0) this.place = this.afterItem(this.run.items - 1);
    this.playing = direction;
    this.pressed();
    this.last = null;  // the first frame sets the clock: its time may lie before this call
    requestAnimationFrame(now => this.tick(now));
  }
  tick(now) {
    if (!this.playing) return;
    this.last ??= now;
    this.late ||= now - this.last > LATE;
    const passed = Math.min(now - this.last, 250) / 1000 * Number(this.find("speed").value);
    this.last = now;
    const t = this.place.t + this.playing * passed, place = this.atTime(t), stop = this.stops.next(this.place, this.playing);
    if (stop && order(stop, place) * this.playing <= 0) {
      this.stop();
      this.go(stop);
      this.find("doing").textContent = `stopped: ${stop.why}`;
      this.find("said").textContent = `stopped: ${stop.why}; ${this.find("said").textContent}`;
      return;
    }
    this.go(place);
    if (this.playing > 0 ? t >= this.run.time : t <= 0) this.stop();
    else requestAnimationFrame(next => this.tick(next));
  }
  stop() {
    if (!this.playing) return;
    this.playing = 0;
    this.late = false;
    this.stops.once = null;
    this.pressed();
    this.say();
    this.show();
  }
  pressed() {
    for (const [id, direction, sign] of [["play", 1, "M4 3v10l8-5z"], ["play-back", -1, "M12 3v10L4 8z"]]) {
      this.find(id).setAttribute("aria-pressed", this.playing === direction);
      this.find(id).querySelector("path").setAttribute("d", this.playing === direction ? "M4 3h3v10H4zM9 3h3v10H9z" : sign);
    }
  }

  // --- showing --------------------------------------------------------------------------------------------------------

  now() {
    const {run, place, step} = this, {item, t, done} = place, rowsDone = run.rowsDone(item, done);
    const row = !run.items || this.atStart ? -1 : run.itemRow[item] >= 0 ? run.itemRow[item] : run.before[item] - 1;
    const {point, speed, share} = done ? {point: run.path.vertex(rowsDone), speed: run.tool(item, t).speed, share: 1} : run.tool(item, t);
    const own = run.items && row === run.itemRow[item], angles = run.angles(row, own ? share : 1);
    const changes = own && share < 1 && run.path.kind[row] === TOOL;  // the tool before is still there
    const length = run.chain ? run.chain.after(changes ? row - 1 : row) : 0;
    return {step, item: this.atStart ? -1 : item, row, rowsDone, share: own && !done ? share : 0, point, speed, angles, length, t};
  }
  show() {  // what is written follows at once, also where the frame of the change before is still to come
    this.write();
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      this.draw(this.turning);
    });
  }
  write() {
    const {run, find} = this, now = this.now(), slider = find("slider");
    slider.value = run.time ? now.t / run.time : 0;
    slider.setAttribute("aria-valuetext", `${seconds(now.t)} of ${seconds(run.time)}`);
    find("clock").textContent = `${seconds(now.t)} / ${seconds(run.time)}`;
    this.board.show(now);
    this.stops.show();
    if (now.step >= 0) {
      const program = run.program[now.step], block = run.block[now.step];
      this.listing.mark(program, run.lines[program][block], run.lasts[program][block]);
    } else this.listing.mark(0, 0, 0);
  }
  draw(turning = false) {
    const {run, picture} = this, now = this.now(), going = now.item >= 0 && run.itemRow[now.item] === now.row ? now.row : -1;
    const tool = run.history.has("tool") && !(run.header.turning?.length > 1) ? run.history.get("tool").value(now.step) : null;
    const lies = run.history.has("tool axis") ? run.history.get("tool axis").value(now.step) : null, along = lies ? "XYZ".indexOf(lies) : 2;
    this.measure.draw();
    picture.draw({row: going, tip: now.point, tool, along, at: Math.max(now.row, 0), angles: now.angles, length: now.length, step: now.step}, now.rowsDone);
    if (this.part && !this.part.draw(now.rowsDone, now.share, going, turning, this.late)) this.show();  // not there yet: go on with the next frame
  }
  showPart(on) {
    if (!this.part) return;
    this.picture.part = on ? this.part : null;
    this.find("part").hidden = !on;
    this.find("show-part").hidden = false;
    this.find("show-part").setAttribute("aria-pressed", on);
    this.find("note").textContent = this.part.note;
    this.find("note").hidden = !on || !this.part.note;
    this.picture.stale = true;
    this.show();
  }
  showMachine(on) {  // the part turns as on the machine, or the tool about it
    const {picture} = this;
    if (!picture.turning || !picture.turning.chain.table.length) return;
    picture.turning.moves = on;
    picture.turning.carry(this.now().angles);
    this.find("show-machine").hidden = false;
    this.find("show-machine").setAttribute("aria-pressed", on);
    picture.stale = true;
    if (picture.fitted) picture.fit();
    this.show();
  }
  showRapids(on) {
    this.picture.rapids = on;
    this.find("show-rapids").setAttribute("aria-pressed", on);
    this.legend();
  }
  colour(name) {  // what the colour of the cuts says
    this.find("colour").value = name;
    this.shades.by(name);
    this.legend();
  }
  legend() {
    const {shades, picture: {strokes, rapids, contour}} = this, kinds = new Set(strokes.kind);
    const words = shades.of ? shades.classes.filter((_, k) => shades.seen.has(k)) : kinds.has(CUTS) ? [["cut", "cut"]] : [];
    if (contour) words.push(["contour", "programmed contour"]);
    if (rapids && kinds.has(RAPIDS)) words.push(["rapid", "rapid", "dashed"]);
    if (kinds.has(PROBINGS)) words.push(["probing", "probing", "dotted"]);
    this.find("legend").replaceChildren(...shades.title ? [shades.title] : [], ...words.map(word => this.sample(...word)));
    this.picture.stale = true;
    this.show();
  }
  sample(name, text, dashes = "solid") {  // a word of a legend
    const word = made("span", {}, text);
    word.style.cssText = `--colour: var(--${name}); --dashes: ${dashes}`;
    return word;
  }
  say() {
    const {run, step} = this, {point, angles} = this.now();
    const of = step >= 0 && run.program[step] ? ` of ${this.listing.name(run.program[step])}` : "";
    const text = step < 0 ? "start" : `line ${run.lineOf(step)}${of}: ${run.texts[run.program[step]][run.lineOf(step) - 1].trim()}`;
    const at = this.board.axes.map(axis => `${run.lathe && axis === 0 ? "diameter" : "XYZ"[axis]} ${this.board.shown(point, axis)}`);
    if (angles) at.push(anglesText(angles, run.turned));
    this.find("said").textContent = `${text}; tool at ${at.join(", ")}`;
    const count = run.path.kind.reduce((n, kind) => n + (kind <= PROBE), 0);
    this.find("picture").setAttribute("aria-label", `tool path, ${count} moves; tool at ${at.join(", ")}`);
  }
  resize(draw = true) {
    const {width, height} = document.body.getBoundingClientRect(), size = [width, height, window.devicePixelRatio].join();
    if (size === this.size) return;  // an observer begins with what is there already
    this.size = size;
    this.picture.resize();
    this.curve.draw(this.picture.colours);
    this.listing.draw();
    if (draw) this.draw();
  }
  view(name) {
    this.picture.view(name);
    this.views();
  }
  views() {
    for (const button of this.find("views").children) button.setAttribute("aria-pressed", button.dataset.view === this.picture.camera.name);
    this.show();
  }
  change(act, goesOn = this.stands > 0) {  // of the camera; it goes on where another change was just before
    this.picture.fitted = false;
    act(this.picture.camera);
    this.picture.stale = true;
    this.views();
    this.turning = goesOn;
    clearTimeout(this.stands);
    this.stands = setTimeout(() => {  // sharp again
      this.stands = 0;
      if (!this.turning) return;
      this.turning = false;
      this.show();
    }, STANDS);
  }
  theme(name) {
    this.root.dataset.theme = name;
    this.root.dataset.shown = name === "auto" ? this.told || (this.dark.matches ? "dark" : "light") : name;
    if (!this.picture) return;
    this.picture.recolour();
    this.curve.draw(this.picture.colours);
    this.show();
  }

  followNotebook() {  // which tells whether it is dark (see notebook.js)
    if (window.parent === window) return;
    addEventListener("message", event => {
      if (event.source !== window.parent || !event.data || !["light", "dark"].includes(event.data.mnclab)) return;
      this.told = event.data.mnclab;
      this.theme(this.root.dataset.theme);
    });
    window.parent.postMessage({mnclab: "theme?"}, "*");
  }

  // --- what moves it --------------------------------------------------------------------------------------------------

  buttons() {
    const {find, run} = this, names = run.lathe ? [["front", "ZX"], ["right", "End"], ["isometric", "3D"]]
      : [["top", "Top"], ["front", "Front"], ["right", "Side"], ["isometric", "3D"]];
    this.viewNames = names.map(([name]) => name);
    find("views").replaceChildren(...names.map(([name, text], k) => {
      const button = made("button", {type: "button", title: `view (${k + 1})`}, text);
      button.dataset.view = name;
      button.addEventListener("click", () => this.view(name));
      return button;
    }));
    const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 25, 100], own = Number(this.root.dataset.speed);
    if (!speeds.includes(own)) speeds.push(own);
    for (const speed of speeds.sort((a, b) => a - b)) find("speed").add(new Option(`${speed}×`, speed, speed === own, speed === own));
    const acts = {
      "start": () => this.afterItem(-1), "end": () => this.afterItem(run.items - 1), "block-back": () => this.blockBack(),
      "block-on": () => this.blockOn(), "move-back": () => this.moveBack(), "move-on": () => this.moveOn(),
    };
    for (const [id, act] of Object.entries(acts)) find(id).addEventListener("click", () => this.jump(act));
    find("play").addEventListener("click", () => this.play(1));
    find("play-back").addEventListener("click", () => this.play(-1));
    find("zoom-in").addEventListener("click", () => this.change(camera => camera.zoomAt(1.3)));
    find("zoom-out").addEventListener("click", () => this.change(camera => camera.zoomAt(1 / 1.3)));
    find("fit").addEventListener("click", () => this.change(() => this.picture.fit()));
    find("fit-head").hidden = !run.chain || !run.chain.head.length;
    find("fit-head").addEventListener("click", () => this.change(() => this.picture.fit(true)));
    find("show-part").addEventListener("click", () => this.showPart(!this.picture.part));
    for (const name of this.shades.names) find("colour").add(new Option(name));
    find("colour").addEventListener("change", event => this.colour(event.target.value));
    find("show-rapids").addEventListener("click", () => this.showRapids(!this.picture.rapids));
    find("show-machine").addEventListener("click", () => this.showMachine(!this.picture.turning.moves));
    find("theme").addEventListener("click", () => this.theme(this.root.dataset.shown === "dark" ? "light" : "dark"));
    find("help").addEventListener("click", () => this.help());
    find("slider").addEventListener("input", event => this.jump(() => this.atTime(event.target.value * run.time)));
    const list = made("dl", {}, ...[...KEYS, ...this.part ? PART_KEYS : [], ...run.chain ? MACHINE_KEYS.filter(([key]) => key === "T" ? run.chain.table.length : run.chain.head.length) : []]
      .flatMap(([key, what]) => [made("dt", {}, key), made("dd", {}, run.lathe && LATHE_KEYS.get(key) || what)]));
    const legend = made("p", {}, ...[["cut", "cut"], ["rapid", "rapid", "dashed"], ["probing", "probing", "dotted"], ["contour", "programmed contour"],
      ["blank", "blank"], ["now", "this move"], ...run.header.fixtures.length ? [["edge", "fixture"]] : [],
      ...this.part ? [["crash", "rapid in material"]] : []].map(word => this.sample(...word)));
    find("keys").append(list, legend);
  }
  jump(act) {
    if (!this.run.items) return;
    this.stop();
    this.go(act());
  }
  help() {
    const box = this.find("keys");
    box.hidden = !box.hidden;
    this.find("help").setAttribute("aria-expanded", !box.hidden);
  }
  alarms() {
    const {alarms, more, collisions} = this.run.header, worst = alarms.find(alarm => alarm.severity === "alarm"), box = this.find("alarm");
    if (!worst && collisions.length) return this.collided(collisions, box);
    const first = worst || alarms[0];
    if (!first) return;
    box.hidden = false;
    box.className = first.severity;
    const where = first.line ? ` in line ${first.line}${first.program ? ` of ${this.listing.name(first.program)}` : ""}` : "";
    box.textContent = `${first.severity}${where}: ${first.message}${more && ` (and ${more})`}`;
    box.addEventListener("click", () => first.line && this.goLine(first.program, first.line));
  }
  collided(collisions, box) {  // where there is no alarm, the first collision has its place
    const [{line, program, message}] = collisions, rest = collisions.length - 1;
    box.hidden = false;
    box.textContent = `collision in line ${line}${program ? ` of ${this.listing.name(program)}` : ""}: ${message}`
      + (rest ? ` (and ${rest} more)` : "");
    box.addEventListener("click", () => this.jump(() => this.afterItem(collisions[0].row < 0 ? -1 : this.run.itemOfRow[collisions[0].row])));
  }
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const {target, key} = event, tag = target.tagName, jump = act => () => this.jump(act);
    if (tag === "SELECT" || (tag === "BUTTON" && (key === " " || key === "Enter"))) return;
    if (tag === "INPUT" && target.type === "text") return key === "Escape" && (this.find("picture").focus(), this.stops.open(false));
    if (tag === "INPUT" && (/^(Arrow|Page|Home|End)/.test(key) || (target.type === "checkbox" && key === " "))) return;
    if (this.measure.on && target.id === "picture" && this.measure.key(key, event.shiftKey)) return event.preventDefault();
    const turn = (yaw, pitch) => () => this.change(camera => camera.turn(yaw, pitch));
    const acts = {
      " ": () => this.playing ? this.stop() : this.play(1), "k": () => this.stop(), "l": () => this.playing > 0 || this.play(1),
      "j": () => this.playing < 0 || this.play(-1), "ArrowRight": jump(() => this.blockOn()), "ArrowLeft": jump(() => this.blockBack()),
      "ArrowDown": jump(() => this.blockOn()), "ArrowUp": jump(() => this.blockBack()), ".": jump(() => this.moveOn()),
      ",": jump(() => this.moveBack()), "Home": jump(() => this.afterItem(-1)), "End": jump(() => this.afterItem(this.run.items - 1)),
      "PageDown": jump(() => this.atTime(this.place.t + 1)), "PageUp": jump(() => this.atTime(this.place.t - 1)),
      "+": () => this.find("zoom-in").click(), "=": () => this.find("zoom-in").click(), "-": () => this.find("zoom-out").click(),
      "f": () => this.find("fit").click(), "h": () => this.find("fit-head").hidden || this.find("fit-head").click(), "p": () => this.showPart(!this.picture.part),
      "t": () => this.picture.turning && this.showMachine(!this.picture.turning.moves),
      "r": () => this.showRapids(!this.picture.rapids), "a": turn(8, 0), "d": turn(-8, 0), "w": turn(0, 8), "s": turn(0, -8),
      "m": () => this.measure.turn(),
      "c": () => this.colour(this.shades.names[(this.shades.names.indexOf(this.shades.name) + 1) % this.shades.names.length]),
      "b": () => this.stops.turnHere(), "n": () => this.stops.jump(event.shiftKey ? -1 : 1), "?": () => this.help(),
      "Escape": () => !this.find("keys").hidden ? this.help() : !this.find("stopping").hidden ? this.stops.open(false)
        : this.measure.on && this.measure.escape(),
    };
    for (const [k, name] of this.viewNames.entries()) acts[k + 1] = () => this.view(name);
    const second = event.shiftKey && {"ArrowRight": "PageDown", "ArrowLeft": "PageUp"}[key];
    const act = acts[second || (key.length === 1 ? key.toLowerCase() : key)];
    if (!act) return;
    event.preventDefault();
    act();
  }
  pointers() {
    const canvas = this.find("picture"), held = new Map(), place = event => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    let travelled = 0;
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, place(event));
      if (held.size === 1) travelled = 0;
    });
    canvas.addEventListener("pointermove", event => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const [x, y] = place(event), dx = x - before[0], dy = y - before[1];
      travelled += Math.hypot(dx, dy);
      if (held.size === 1 && travelled > 4) {
        const shifts = this.run.lathe !== (event.shiftKey || event.buttons > 1);
        this.change(camera => shifts ? camera.pan(dx, dy) : camera.turn(-dx * 0.5, dy * 0.5), true);
      } else if (held.size === 2) {
        const other = [...held].find(([id]) => id !== event.pointerId)[1];
        const apart = Math.hypot(before[0] - other[0], before[1] - other[1]) || 1;
        this.change(camera => {
          camera.pan(dx / 2, dy / 2);
          camera.zoomAt(Math.hypot(x - other[0], y - other[1]) / apart, (x + other[0]) / 2, (y + other[1]) / 2);
        });
      }
      held.set(event.pointerId, [x, y]);
    });
    canvas.addEventListener("pointerup", event => {
      const [x, y] = place(event), alone = held.size === 1;
      held.delete(event.pointerId);
      if (!alone || travelled > 4) return;
      if (this.measure.on) return this.measure.click(x, y, event.pointerType === "touch");
      const row = this.picture.strokes.pick(x, y, this.picture.camera, event.pointerType === "touch" ? 18 : 9, this.picture.rapids);
      if (row >= 0) this.goRow(row, x, y);
    });
    canvas.addEventListener("pointercancel", event => held.delete(event.pointerId));
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("wheel", event => {  // in a notebook the wheel belongs to the notebook until the picture is clicked
      if (window.top === window || document.activeElement === canvas || event.ctrlKey) {
        event.preventDefault();
        this.change(camera => camera.zoomAt(Math.exp(-event.deltaY * 0.0015), ...place(event)), true);
      }
    }, {passive: false});
  }
}

function seconds(t) {
  const minutes = Math.floor(t / 60), rest = (t - 60 * minutes).toFixed(2).padStart(5, "0");
  return minutes >= 60 ? `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}:${rest}` : `${minutes}:${rest}`;
}

inflated("data").then(bytes => {
  window.player = new PlayerPage(new Recorded(unpack(bytes)));
});
