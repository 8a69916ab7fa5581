// What is active, in words: position, feed, spindle, tool, modal state, and what the block changed.

const APART = ["position", "rotary", "feed", "per_rev", "speed", "turning", "tool"];  // said by the read-outs

function frameText(rows, mm) {
  const at = rows.slice(0, 3).map(row => row[3]), parts = [], m = rows.map(row => row.slice(0, 3));
  const near = (a, b) => Math.abs(a - b) < 1e-9;
  at.forEach((value, k) => { if (!near(value, 0)) parts.push("XYZ"[k] + lengthText(value, mm)); });
  const scale = [0, 1, 2].map(k => Math.hypot(m[0][k], m[1][k], m[2][k]));
  const determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
    + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  const straight = [0, 1, 2].every(k => near(Math.abs(m[k][k]), scale[k]));
  if (straight) [0, 1, 2].forEach(k => { if (m[k][k] < 0) parts.push("mirror " + "XYZ"[k]); });
  else {
    if (determinant < 0) parts.push("mirrored");
    const plane = [[0, 1], [2, 0], [1, 2]].find((_, k) => near(Math.abs(m[[2, 1, 0][k]][[2, 1, 0][k]]), scale[[2, 1, 0][k]]));
    if (plane && determinant > 0) parts.push("turned " + short(Math.atan2(m[plane[1]][plane[0]], m[plane[0]][plane[0]]) * 180 / Math.PI) + "°");
    else parts.push("turned");
  }
  if (scale.some(value => !near(value, 1)))
    parts.push("scale " + (scale.every(value => near(value, scale[0])) ? short(scale[0], 6) : scale.map(each => short(each, 6)).join(" × ")));
  return parts.join(" ") || "none";
}

// At most three decimals, as displays have them; what these would not show has its first two figures.
function short(value, decimals = 3) {
  const bare = text => text.includes(".") ? text.replace(/\.?0+$/, "") : text, text = bare(number(value, decimals));
  return text === "0" && value ? bare(number(Number(value.toPrecision(2)), 12)) : text;
}

// A length of mm in the unit of the program: inches have a digit more.
function lengthText(value, mm) {
  return short(value / mm, mm > 1 ? 4 : 3);
}

// Rotary axes in degrees, those that a run turns: "A 15° C −90°".
function anglesText(angles, turned) {
  return angles.map((angle, k) => turned[k] ? `${"ABC"[k]} ${short(angle)}°` : "").filter(Boolean).join("  ");
}

function stockText([axis, low, high], mm) {
  const corner = point => point.map((value, k) => "XYZ"[k] + lengthText(value, mm)).join(" ");
  return typeof axis === "string" && low ? `${corner(low)}${high ? " to " + corner(high) : ""}` : "turned body";
}

function toolText(tool, mm) {
  if (!tool || (!tool.number && !tool.radius)) return "none";
  const size = tool.radius ? `R${lengthText(tool.radius + (tool.dr || 0), mm)}` : "";
  return [`T${tool.number}`, tool.name, size].filter(Boolean).join(" ");
}

// A value in words; `mm` is what a length of 1 in it stands for.
function valueText(name, value, mm) {
  if (value === null || value === undefined) return "none";
  if (name.startsWith("frame ")) return frameText(value, mm);
  if (value && value.radius !== undefined) return toolText(value, mm);
  if (name === "rotary") return anglesText(value.map(angle => angle * 180 / Math.PI), value.map(angle => angle !== 0)) || "0°";
  if (name === "feed") return lengthText(value, mm);
  if (name === "stock") return stockText(value, mm);
  if (name === "kinematics")  // where its axes lie
    return [...value.head, ...value.table].map(each => `${each.name} ${each.centre.map(v => lengthText(v, mm)).join(" ")}`).join(", ");
  if (name === "pole") return value.map(each => lengthText(each, mm)).join(" ");
  if (name === "side") return ["right", "none", "left"][value + 1];
  if (typeof value === "number") return short(value);
  if (typeof value === "boolean") return value ? "on" : "off";
  if (Array.isArray(value)) return value.map(each => valueText("", each, 1)).join(" ");
  if (typeof value === "object") return Object.entries(value).filter(([, v]) => v).map(([k, v]) => `${k} ${valueText("", v, 1)}`).join(" ");
  return String(value);
}

class Board {
  constructor(run, find) {
    this.run = run;
    this.find = find;
    this.step = -2;
    find("angles").hidden = !run.rotary || Boolean(run.chain);
    find("position-unit").textContent = find("feed-unit").textContent = run.unit.short;
    const axes = run.lathe ? ["⌀ X", "Z"] : ["X", "Y", "Z"];
    this.axes = run.lathe ? [0, 2] : [0, 1, 2];
    this.rotary = run.chain ? run.chain.axes : [];  // stand beside X Y Z
    find("axes").replaceChildren(...[...axes, ...this.rotary.map(({name}) => name)].map(name => made("tr", {}, made("th", {scope: "row"}, name),
      ...["program", "tool", "machine"].map(column => made("td", {id: `${column}-${name.slice(-1)}`})))));
    if (run.chain) Object.assign(find("machine"), {title: "the spindle reference in machine coordinates, and the rotary axes in degrees"});
  }
  // A coordinate as the operator reads it: a lathe's X is a diameter; or as the program says it, where that may be a radius.
  shown(point, axis, told = false) {
    const {unit, lathe, header: {radii}} = this.run, across = lathe && axis === 0, radius = across && told && radii;
    return (radius ? "R " : "") + number(point[axis] / unit.length * (across && !radius ? 2 : 1), unit.decimals);
  }
  positions(column, point) {
    for (const axis of this.axes) this.find(`${column}-${"XYZ"[axis]}`).textContent = point ? this.shown(point, axis, column === "program") : "–";
  }
  show({step, row, point, speed, item, angles, length}) {
    const {run, find} = this, {unit} = run, at = Math.max(row, 0);
    this.positions("tool", point);
    this.positions("machine", run.header.turning ? null : run.reference(point, angles, at, length));
    for (const {name, number: axis} of this.rotary) find(`machine-${name}`).textContent = `${number(angles[axis], 3)}°`;
    const feed = run.row.feed.value(at), perRev = run.row.per_rev.value(at), spindle = run.turning(at, point);
    const kind = row >= 0 ? run.path.kind[row] : -1, own = item >= 0 && run.itemRow[item] === row;
    const programmed = perRev ? `${lengthText(perRev, unit.length)} ${unit.short}/rev` : kind === RAPID ? "rapid" : typeof feed === "number" ? `F ${lengthText(feed, unit.length)}` : "";
    find("feed").textContent = number(speed * 60 / unit.length, unit.length > 1 ? 1 : 0);
    find("feed-programmed").textContent = own && kind <= PROBE ? programmed : "";
    find("spindle").textContent = number(Math.abs(spindle), 0);
    find("turning").textContent = spindle > 0 ? "clockwise" : spindle < 0 ? "counter-clockwise" : "stopped";
    const label = row >= 0 && own ? run.row.label.value(row) : "";
    find("doing").textContent = !own ? "" : label || KINDS[kind];
    if (angles) find("rotary").textContent = anglesText(angles, run.turned);
    const tool = toolText(step >= 0 && run.history.get("tool")?.value(step), unit.length), drawn = run.inserts?.tools[run.inserts.which.value(at) || 0];
    find("tool").textContent = tool === "none" && drawn ? `${drawn.name} (no T)` : tool;
    if (step === this.step) return;
    this.step = step;
    this.positions("program", step >= 0 ? run.position(step) : null);
    const state = step >= 0 ? run.state(step) : {};
    this.modal(step, state);
  }
  modal(step, state) {
    const {run} = this, before = step > 0 ? run.state(step - 1) : {}, text = step >= 0 ? run.texts[run.program[step]][run.lineOf(step) - 1] : "";
    const changed = new Set(step >= 0 ? run.changed(step) : []);
    const names = [...new Set([...Object.keys(state), ...[...changed].filter(name => before[name] !== undefined)])];
    const cells = names.filter(name => !APART.includes(name) || (changed.has(name) && name !== "position" && step > 0)).map(name => {
      const mm = name === "feed" && state.per_time ? 1 : run.unit.length;
      const now = valueText(name, state[name], mm), old = before[name] === undefined ? (name === "rotary" ? "0°" : "") : valueText(name, before[name], mm);
      // the first step also sets what is active at power-on: there only what stands in the block is its doing
      const mark = step > 0 ? changed.has(name) && now !== (old || "none") : text.includes(now) && changed.has(name);
      if (!mark && (now === "none" || APART.includes(name))) return null;
      const told = mark && old ? `${old} → ${now}` : now;
      return made("div", mark && {className: "changed"}, made("dt", {}, name.replace(/_/g, " ")), made("dd", {}, told));
    }).filter(Boolean);
    cells.sort((a, b) => (b.className > a.className) - (b.className < a.className));
    this.find("modal").replaceChildren(...cells);
  }
}
