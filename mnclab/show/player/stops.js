// Where the playing stops: at blocks, where a question becomes true, at tool changes, alarms and collisions; and what is watched
// meanwhile. A stop is a place with `why`; at a block it is the moment before it is obeyed.

// Which of two places comes first: below zero the one, above it the other.
function order(a, b) {
  return a.item - b.item || a.done - b.done || a.t - b.t;
}

const keyOf = (program, block) => program * 2 ** 32 + block;

class Stops {
  constructor(page) {
    const {run, find} = page;
    Object.assign(this, {page, run, find, asked: new Asked(run), blocks: new Map(), all: [], moments: [], once: null, watched: []});
    const own = [...run.history.keys()].find(name => /^(Q[LR]?|#)\d+$/.test(name)), axis = run.lathe ? "d" : "z";  // as examples
    find("when").placeholder = run.lathe ? "d < 20 and z < -5" : "z < -5 and tool == 2";
    find("watch").placeholder = [...own ? [own] : [], axis, "feed", ...own ? [`x - ${own}`] : []].join(", ");
    find("stops").addEventListener("click", () => this.open());
    find("when").addEventListener("change", () => this.ask());
    find("watch").addEventListener("change", () => this.watch());
    for (const id of ["stop-tool", "stop-alarm", "stop-collision"]) find(id).addEventListener("change", () => this.gather());
    find("stop-back").addEventListener("click", () => this.jump(-1));
    find("stop-on").addEventListener("click", () => this.jump(1));
    this.gather();
  }
  open(on = this.find("stopping").hidden) {
    this.find("stopping").hidden = !on;
    this.find("stops").setAttribute("aria-expanded", on);
    if (on) this.find("when").focus();
  }
  // A stop at the block of a line, or none there any more.
  turn(program, line) {
    const {run} = this, block = run.blockOfLine(program, line), key = keyOf(program, block);
    if (block < 0 || line > run.lasts[program][block]) return;
    if (!this.blocks.delete(key)) this.blocks.set(key, {program, block});
    this.gather();
  }
  has(program, line) {
    return this.blocks.has(keyOf(program, this.run.blockOfLine(program, line)));
  }
  turnHere() {
    const {run, page: {step}} = this;
    if (step >= 0) this.turn(run.program[step], run.lineOf(step));
  }
  told(text) {  // a question as it is meant: of a lathe the programs mostly say diameters
    return this.run.lathe ? text.replace(/\bx\b/gi, "$& (radius)") : text;
  }
  ask() {
    const text = this.find("when").value.trim();
    let said = "", wrong = false;
    this.moments = [];
    if (text) try {
      const question = this.asked.question(text);
      question.logical(question.tree);
      this.moments = this.asked.moments(question).map(each => ({...this.asked.place(each), why: this.told(text)}));
      said = this.moments.length ? `becomes true ${this.moments.length === 1 ? "once" : `${this.moments.length} times`}` : "never true";
      if (this.told(text) !== text) said = `${this.told(text)} ${said}`;
    } catch (fault) {
      [said, wrong] = [fault.message, true];
    }
    this.find("when").setAttribute("aria-invalid", wrong);
    this.find("when-said").textContent = this.find("said").textContent = said;
    this.gather();
  }
  // All stops, in order.
  gather() {
    const {run, page, find, blocks} = this, found = [...this.moments], on = id => find(id).checked;
    const before = (step, why) => ({item: run.first[step], t: run.begin[run.first[step]], done: false, why});
    const alarms = on("stop-alarm") ? page.listing.alarms : new Map();
    if (blocks.size || alarms.size) for (let step = 0; step < run.steps; step++) {
      const [program, block] = [run.program[step], run.block[step]];
      if (blocks.has(keyOf(program, block))) found.push(before(step, page.listing.place(program, run.lineOf(step))));
      for (let line = run.lines[program][block]; alarms.size && line <= run.lasts[program][block]; line++) {
        const alarm = alarms.get(`${program} ${line}`);
        if (alarm && alarm.severity !== "collision") found.push(before(step, alarm.message));
      }
    }
    const tools = run.history.get("tool");
    if (on("stop-tool") && tools) tools.at.forEach((step, k) => {
      const [old, tool] = [k ? tools.values[tools.of[k - 1]] : null, tools.values[tools.of[k]]];
      if (tool && tool.number !== (old ? old.number : 0)) found.push({...page.afterStep(step), why: toolText(tool, run.unit.length)});
    });
    if (on("stop-collision")) for (const {row, place, message} of run.header.collisions)
      if (row >= 0) found.push({...page.nearest(row, point => Math.hypot(...point.map((v, k) => v - place[k]))), why: message});
    this.all = found.sort(order);
    this.list();
    page.listing.draw(true);
    page.curve.draw(page.picture.colours);
  }
  list() {
    const {run, page, blocks} = this, button = (textContent, title, act) => {
      const found = made("button", {type: "button", textContent, title});
      found.addEventListener("click", act);
      return found;
    };
    const items = [...blocks.values()].map(({program, block}) => {
      const line = run.lines[program][block], place = page.listing.place(program, line);
      const away = button("×", `no stop at ${place}`, () => this.turn(program, line));
      away.setAttribute("aria-label", away.title);
      return made("li", {}, button(`${place}: ${run.texts[program][line - 1].replace(NUMBERED, "").trim()}`, "goes there", () => page.goLine(program, line)), away);
    });
    this.find("breaks").replaceChildren(...items);
    this.find("stops").textContent = this.all.length ? `Breakpoints (${this.all.length})` : "Breakpoints";
  }
  // The first stop behind a place, or before it; null if there is none.
  next(place, direction) {
    const all = this.once ? [...this.all, this.once].sort(order) : this.all;
    let low = 0, high = all.length;
    while (low < high) {
      const middle = (low + high) >> 1, side = order(all[middle], place);
      if (direction > 0 ? side <= 0 : side < 0) low = middle + 1; else high = middle;
    }
    return all[direction > 0 ? low : low - 1] || null;
  }
  jump(direction) {
    const {page} = this, stop = this.next(page.place, direction);
    if (!stop) return page.tell(direction > 0 ? "no stop from here on" : "no stop before");
    page.jump(() => stop);
    page.tell(`stop: ${stop.why}`);
  }
  // Play until the block of a line is next.
  runTo(program, line) {
    const {run, page} = this, block = run.blockOfLine(program, line), step = block < 0 ? -1 : run.execution(program, block, page.step);
    if (step < 0) return page.tell(`line ${line} is not executed`);
    const item = run.first[step];
    page.stop();
    this.once = {item, t: run.begin[item], done: false, why: page.listing.place(program, line)};
    if (order(this.once, page.place) <= 0) page.go(page.afterItem(-1));
    page.play(1);
  }

  // --- what is watched ------------------------------------------------------------------------------------------------

  watch() {
    const state = new Map([...this.run.history.keys()].map(name => [name.toLowerCase(), name])), {asked} = this;
    this.watched = this.find("watch").value.split(/[,;]/).map(text => text.trim()).filter(Boolean).map(text => {
      const name = state.get(text.toLowerCase());
      try {
        return {text, question: asked.question(text)};
      } catch (fault) {
        return name ? {text, name} : {text, fault: fault.message};
      }
    });
    this.show();
  }
  show() {
    const {run, page, find, asked} = this, {item, t, done} = page.place, row = run.items ? run.itemRow[item] : -1;
    const share = done || row < 0 ? 1 : asked.loose(item) ? (t - run.begin[item]) / (run.end[item] - run.begin[item]) : run.tool(item, t).share;
    find("watched").replaceChildren(...(run.items ? this.watched : []).map(({text, name, question, fault}) => {
      const told = question && (question.tree.value || question.tree.truth)(asked.values(item, share));
      const value = fault || (name ? valueText(name, run.history.get(name).value(page.step), run.unit.length)
        : typeof told === "boolean" ? (told ? "true" : "false") : told === null || Number.isNaN(told) ? "not known"
        : Number.isFinite(told) ? short(told, 4) : question.names.has("feed") ? "rapid" : "no limit");
      return made("div", {}, made("dt", {}, this.told(text)), made("dd", {}, value));
    }));
  }
}
