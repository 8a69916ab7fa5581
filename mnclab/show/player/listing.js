// The text of the program. Only the lines in sight are in the page, so that a million lines cost nothing.

class Listing {
  constructor(box, run, go) {
    this.box = box;
    this.run = run;
    this.go = go;
    this.program = 0;
    this.from = this.to = -1;  // the block going on, lines from 1
    this.sheet = document.createElement("div");
    this.sheet.className = "sheet";
    box.append(this.sheet);
    this.height = 20;
    box.style.setProperty("--digits", Math.max(3, ...run.texts.map(text => String(text.length).length)));
    this.alarms = new Map(run.header.alarms.filter(alarm => alarm.line).map(alarm => [alarm.line, alarm]));
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
  // Mark a block and bring it into sight.
  mark(program, from, to) {
    const moved = program !== this.program || from !== this.from;
    [this.program, this.from, this.to] = [program, from, to];
    if (moved && from > 0) this.reveal(from);
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
    const key = [this.program, this.from, this.to, first, end].join();
    if (key === this.shown) return;
    this.shown = key;
    this.sheet.style.height = text.length * height + "px";
    const lines = [];
    for (let k = first; k < end; k++) {
      const row = document.createElement("div"), now = k + 1 >= this.from && k + 1 <= this.to, alarm = this.alarms.get(k + 1);
      row.className = "line" + (now ? " now" : "") + (alarm && this.program === 0 ? " " + alarm.severity : "");
      row.style.top = k * height + "px";
      row.dataset.line = k + 1;
      row.id = "line-" + (k + 1);
      row.setAttribute("role", "option");
      row.setAttribute("aria-setsize", text.length);
      row.setAttribute("aria-posinset", k + 1);
      row.setAttribute("aria-selected", now);
      row.setAttribute("aria-label", `line ${k + 1}: ${text[k].trim() || "empty"}`);
      if (alarm && this.program === 0) row.title = alarm.message;
      const figure = document.createElement("span"), code = document.createElement("code");
      figure.textContent = k + 1;
      code.textContent = text[k];
      row.append(figure, code);
      lines.push(row);
    }
    this.sheet.replaceChildren(...lines);
    if (this.from > 0) box.setAttribute("aria-activedescendant", "line-" + this.from);
    else box.removeAttribute("aria-activedescendant");
  }
}
