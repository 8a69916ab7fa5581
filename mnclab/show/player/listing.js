const NUMBERED = /^\s*(?:\/\s*)?(N\s*\d+|\d+)(?!\S)/i;  // a block that begins with its number

// The text of the program. Only the lines in sight are in the page, so that a million lines cost nothing.

class Listing {
  constructor(box, run, choice, {go, to, stop}) {  // what clicks do: on a line, with shift, on its number
    this.box = box;
    this.run = run;
    this.program = 0;  // the one shown
    this.going = {program: 0, from: -1, to: -1};  // the block going on, lines from 1
    this.choice = choice;
    this.heads = box.previousElementSibling;
    this.sheet = made("div", {className: "sheet"});
    box.append(this.sheet);
    this.height = 20;
    box.parentElement.style.setProperty("--digits", Math.max(3, ...run.texts.map(text => String(text.length).length)));
    this.alarms = new Map();  // an alarm stands above a collision, that above a warning, the first above others
    const {alarms, collisions} = run.header, said = severity => alarms.filter(alarm => alarm.severity === severity);
    const crashes = collisions.map(({program, line, message}) => ({severity: "collision", message, places: [[program, line]]}));
    for (const alarm of [...said("alarm"), ...crashes, ...said("warning")])
      for (const place of alarm.places) this.alarms.has(place.join(" ")) || this.alarms.set(place.join(" "), alarm);
    choice.hidden = run.texts.length < 2;
    run.texts.forEach((_, k) => choice.add(new Option(this.name(k), k)));
    choice.addEventListener("change", () => this.turnTo(Number(choice.value)));
    this.shown = "";
    box.addEventListener("scroll", () => this.draw());
    this.sheet.addEventListener("click", event => {
      const line = event.target.closest("[data-line]");
      if (line) (event.target.tagName === "SPAN" ? stop : event.shiftKey ? to : go)(this.program, Number(line.dataset.line));
    });
    const known = LANGUAGES.filter(({control}) => control === run.header.name);  // Klartext, and DIN/ISO, which begins with %
    this.tokens = run.header.programs.map(({text}) => known[0] && tokenOf((known.find(({name}) => /^\s*%/.test(text) !== /Klartext/.test(name)) || known[0]).rules));
    this.numbered = run.texts.map(text => text.filter(line => NUMBERED.test(line)).length > 1);
  }
  // The pieces of a line in the colours that its control has in the editor.
  coloured(string) {
    const pieces = [], stream = {string, pos: 0, sol: () => false, next: () => stream.pos++}, token = this.tokens[this.program];
    while (token && stream.pos < string.length) {
      const from = stream.pos, name = token(stream), piece = string.slice(from, stream.pos), [before] = pieces.slice(-1);
      if (name) pieces.push(made("i", {className: name.split(".")[0]}, piece));
      else if (typeof before === "string") pieces[pieces.length - 1] += piece;
      else pieces.push(piece);
    }
    return token ? pieces : [string];
  }
  // A line as people name it: "line 23, block 22".
  place(program, line) {
    const [, number] = NUMBERED.exec(this.run.texts[program][line - 1]) || [], of = program ? ` of ${this.name(program)}` : "";
    return `line ${line}${number ? `, block ${number}` : ""}${of}`;
  }
  get text() {
    return this.run.texts[this.program];
  }
  // What a program is called, without its folders.
  name(program) {
    return this.run.header.programs[program].name.replace(/^.*[\\/]/, "");
  }
  // Show another program than the one going on.
  turnTo(program) {
    if (program === this.program) return;
    this.program = program;
    this.choice.value = program;
    this.box.scrollTop = 0;
    if (program === this.going.program && this.going.from > 0) this.reveal(this.going.from);
    this.draw();
  }
  // Mark a block and bring it into sight.
  mark(program, from, to) {
    const moved = program !== this.going.program || from !== this.going.from || to !== this.going.to;
    this.going = {program, from, to};
    if (moved) {
      this.turnTo(program);
      if (from > 0) this.reveal(from);
      this.draw();
    }
  }
  reveal(line) {
    const top = (line - 1) * this.height, high = this.box.clientHeight;
    if (top < this.box.scrollTop + this.height || top > this.box.scrollTop + high - 2 * this.height)
      this.box.scrollTop = Math.max(0, top - high * 0.38);
  }
  draw(anew) {
    const {box, text, height} = this, first = Math.max(0, Math.floor(box.scrollTop / height) - 4);
    const end = Math.min(text.length, Math.ceil((box.scrollTop + box.clientHeight) / height) + 4);
    const here = this.going.program === this.program, from = here ? this.going.from : 0, to = here ? this.going.to : 0;
    const key = [this.program, from, to, first, end].join();
    if (key === this.shown && !anew) return;
    this.shown = key;
    this.heads.classList.toggle("numbered", this.numbered[this.program]);
    this.sheet.style.height = text.length * height + "px";
    const lines = [];
    for (let k = first; k < end; k++) {
      const now = k + 1 >= from && k + 1 <= to, alarm = this.alarms.get(`${this.program} ${k + 1}`);
      const stops = this.stops && this.stops.has(this.program, k + 1);
      const title = `${this.place(this.program, k + 1)}: a click sets a stop, or takes it away`;
      const row = made("div", {id: "line-" + (k + 1)}, made("span", {title}, k + 1), made("code", {}, ...this.coloured(text[k])));
      row.className = "line" + (now ? " now" : "") + (alarm ? " " + alarm.severity : "") + (stops ? " stops" : "");
      row.style.top = k * height + "px";
      row.dataset.line = k + 1;
      row.setAttribute("role", "option");
      row.setAttribute("aria-setsize", text.length);
      row.setAttribute("aria-posinset", k + 1);
      row.setAttribute("aria-selected", now);
      row.setAttribute("aria-label", `line ${k + 1}: ${text[k].trim() || "empty"}${stops ? "; stops here" : ""}`);
      if (alarm) row.title = alarm.message;
      lines.push(row);
    }
    this.sheet.replaceChildren(...lines);
    if (from > 0) box.setAttribute("aria-activedescendant", "line-" + from);
    else box.removeAttribute("aria-activedescendant");
  }
}
