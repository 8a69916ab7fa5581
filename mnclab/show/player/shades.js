// What the colour of a cut says: its kind, feed, tool, or engagement. `of` gives each row a class, `classes` their colours and
// names, `title` what they are in which unit.

const MOST_SHADES = 6;  // colours --c0 to --c5 of the style sheet; classes that have a value more are ranges

class Shades {
  constructor(run, carving) {
    this.run = run;
    this.carving = carving;
    this.names = ["kind", "feed", "tool", ...carving ? ["engagement"] : []];
    this.by("kind");
  }
  by(name) {
    const {run} = this, {path, row: columns} = run, {length, short: unit} = run.unit;
    const cuts = [...path.kind.keys()].filter(row => (path.kind[row] === LINE || path.kind[row] === ARC) && !run.probes(row));
    this.name = name;
    this.of = this.classes = null;
    this.title = "";
    if (name === "kind") return;
    if (name === "engagement") return this.engaged(cuts);
    const per = name === "feed" && cuts.length && cuts.every(row => typeof columns.per_rev.value(row) === "number");
    const column = per ? columns.per_rev : columns[name], value = row => Math.round(known(column.value(row)) / (per || name === "feed" ? length : 1) * 1e6) / 1e6;
    const values = [...new Set(cuts.map(value))].filter(Number.isFinite).sort((a, b) => a - b), size = Math.max(1, values.length / MOST_SHADES);
    const rank = new Map(values.map((each, k) => [each, Math.floor(k / size)])), groups = [];
    values.forEach(each => (groups[rank.get(each)] ||= []).push(each));
    const tools = run.history.has("tool") ? run.history.get("tool").values.filter(Boolean) : [];
    const said = group => name === "tool" ? group.map(number => toolText(tools.find(tool => tool.number === number), length).replace("none", `T${number}`)).join(", ")
      : group.length > 1 ? `${short(group[0])} to ${short(group[group.length - 1])}` : short(group[0]);
    this.title = name === "tool" ? "tool" : `feed, ${unit}/${per ? "rev" : "min"}`;
    this.fill(cuts, row => rank.get(value(row)), groups.map(said));
  }
  engaged(cuts) {  // known of the rows that were cut ahead
    const {engaged} = this.carving;
    this.title = `engagement at most, degrees${this.carving.scouted ? "" : " …"}`;
    this.fill(cuts, row => engaged[row] > 0 ? Math.ceil(engaged[row] / 30) - 1 : undefined, [30, 60, 90, 120, 150, 180].map(most => `to ${most}`));
  }
  fill(cuts, rank, names) {
    this.of = new Uint8Array(this.run.path.n);
    for (const row of cuts) this.of[row] = rank(row) ?? names.length;
    const step = names.length > 1 ? (MOST_SHADES - 1) / (names.length - 1) : 1;
    this.classes = [...names.map((text, k) => [`c${Math.round(k * step)}`, text]), ["quiet", "none"]];
    this.seen = new Set(cuts.map(row => this.of[row]));
  }
}
