// The text of the program. Only the lines in sight are in the page, so that a million lines cost nothing.

class Listing {
  constructor(box, run, go, choice) {
    this.box = box;
    this.run = run;
    this.go = go;
    this.program = 0;  // the one shown
    this.going = {program: 0, from: -1, to: -1};  // the block going on, lines from 1
    this.choice = choice;
    this.sheet = document.createElement("div");
    this.sheet.className = "sheet";
    box.append(this.sheet);
    this.height = 20;
    box.style.setProperty("--digits", Math.max(3, ...run.texts.map(text => String(text.length).length)));
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
      if (line) go(this.program, Number(line.dataset.line));
    });
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
    }
    this.draw();
  }
  reveal(line) {
    const top = (line - 1) * this.height, high = this.box.clientHeight;
    if (top < this.box.scrollTop + this.height || top > this.box.scrollTop + high - 2 * this.height)
      this.box.scrollTop = Math.max(0, top - high * 0.38);
  }
  draw() {
    const {box, text, height} = this, first = Math.max(0, Math.floor(box.scrollTop / height) - 4);
    const end = Math.min(text.length, Math.ceil((box.scrollTop + box.clientHeight) / height) + 4);
    const here = this.going.program === this.program, from = here ? this.going.from : 0, to = here ? this.going.to : 0;
    const key = [this.program, from, to, first, end].join();
    if (key === this.shown) return;
    this.shown = key;
    this.sheet.style.height = text.length * height + "px";
    const lines = [];
    for (let k = first; k < end; k++) {
      const row = document.createElement("div"), now = k + 1 >= from && k + 1 <= to, alarm = this.alarms.get(`${this.program} ${k + 1}`);
      row.className = "line" + (now ? " now" : "") + (alarm ? " " + alarm.severity : "");
      row.style.top = k * height + "px";
      row.dataset.line = k + 1;
      row.id = "line-" + (k + 1);
      row.setAttribute("role", "option");
      row.setAttribute("aria-setsize", text.length);
      row.setAttribute("aria-posinset", k + 1);
      row.setAttribute("aria-selected", now);
      row.setAttribute("aria-label", `line ${k + 1}: ${text[k].trim() || "empty"}`);
      if (alarm) row.title = alarm.message;
      const figure = document.createElement("span"), code = document.createElement("code");
      figure.textContent = k + 1;
      code.textContent = text[k];
      row.append(figure, code);
      lines.push(row);
    }
    this.sheet.replaceChildren(...lines);
    if (from > 0) box.setAttribute("aria-activedescendant", "line-" + from);
    else box.removeAttribute("aria-activedescendant");
  }
}
