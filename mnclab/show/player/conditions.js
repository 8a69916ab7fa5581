// Questions about a run in the words of `run.when`: `z < -5`, `Q5 > 3 and not tool == 2` (see runs/conditions.py). A part of one
// is {value, names, degree} for a number, {truth, names} for a comparison; what is not known is NaN, and neither true nor
// false (null).

const EQUAL = 1e-9, LOOKS = 16, HALVED = 60;
const OR = 0, AND = 1, NOT = 2, COMPARISON = 3, POWER = 6;
const LEVELS = {or: OR, and: AND, "+": 4, "-": 4, "*": 5, "/": 5, "^": POWER};
const COMPARE = {
  "<": gap => gap < -EQUAL, "<=": gap => gap <= EQUAL, "==": gap => Math.abs(gap) <= EQUAL,
  ">": gap => gap > EQUAL, ">=": gap => gap >= -EQUAL, "!=": gap => Math.abs(gap) > EQUAL,
};
for (const mark of ["=", ...Object.keys(COMPARE)]) LEVELS[mark] = COMPARISON;
const ARITHMETIC = {
  "+": (a, b) => a + b, "-": (a, b) => a - b, "*": (a, b) => a * b, "/": (a, b) => b === 0 ? NaN : a / b, "^": (a, b) => a ** b,
};
const RADIAN = Math.PI / 180, FUNCTIONS = {
  abs: Math.abs, sqrt: Math.sqrt, sin: a => Math.sin(a * RADIAN), cos: a => Math.cos(a * RADIAN), tan: a => Math.tan(a * RADIAN),
};
const PLACES = ["x", "y", "z", "d", "a", "b", "c"], COLUMNS = ["feed", "spindle", "tool", "radius", "side", "line"];

class Question {
  constructor(text, known) {
    this.tokens = [...text.matchAll(/\s*(?:(\d+\.?\d*|\.\d+)|([A-Za-z_#]\w*)|(<=|>=|==|!=|[-+*/^()<>=])|(\S))/g)].map(([, ...parts]) => parts);
    this.known = new Map([...known].map(name => [name.toLowerCase(), name]));
    this.at = 0;
    this.comparisons = [];
    this.tree = this.climb(0);
    if (this.at < this.tokens.length) this.refuse("an operator was expected before");
    this.names = this.tree.names;
  }
  peek() {
    return (this.tokens[this.at] || []).find(Boolean)?.toLowerCase() || "";
  }
  refuse(what) {
    throw Error(`${what} ${this.at < this.tokens.length ? `'${this.tokens[this.at].find(Boolean)}'` : "the end"}`);
  }
  climb(level) {
    let left = this.operand(level);
    for (let mark = this.peek(); LEVELS[mark] >= level; mark = this.peek()) {
      this.at++;
      left = this.join(mark, left);
    }
    return left;
  }
  join(mark, left) {
    const level = LEVELS[mark];
    if (level === COMPARISON) return this.compared(mark, this.number(left));
    const right = this.climb(mark === "^" ? level : level + 1), names = new Set([...left.names, ...right.names]);
    if (level <= AND) return this.both(this.logical(left), this.logical(right), level === OR);
    const [a, b] = [this.number(left), this.number(right)], act = ARITHMETIC[mark], some = a.degree || b.degree;
    const degree = mark === "*" ? a.degree + b.degree : mark === "+" || mark === "-" ? Math.max(a.degree, b.degree)
      : mark === "/" && !b.degree ? a.degree : some ? Infinity : 0;
    return {value: v => act(a.value(v), b.value(v)), names, degree};
  }
  both(a, b, either) {  // `either`: or, which is true where "and" is false
    return {names: new Set([...a.names, ...b.names]), truth: v => {
      const [one, other] = [a.truth(v), b.truth(v)];
      return one === either || other === either ? either : one === null || other === null ? null : !either;
    }};
  }
  compared(mark, left) {
    const right = this.number(this.climb(COMPARISON + 1)), is = COMPARE[mark === "=" ? "==" : mark];
    const gap = v => left.value(v) - right.value(v), found = {
      left, right, gap, names: new Set([...left.names, ...right.names]), mixed: Math.max(left.degree, right.degree) > 1,
      truth: v => { const apart = gap(v); return Number.isNaN(apart) ? null : is(apart); },
    };
    this.comparisons.push(found);
    const next = this.peek();
    if (LEVELS[next] !== COMPARISON) return found;
    this.at++;
    return this.both(found, this.compared(next, right), false);  // a chain: all must be true
  }
  operand(level) {
    const word = this.peek();
    if (word !== "-" && word !== "+" && (word !== "not" || level > NOT)) return this.part();
    this.at++;
    const inner = word === "not" ? this.logical(this.climb(NOT)) : this.number(this.climb(POWER));
    if (word === "not") return {names: inner.names, truth: v => { const told = inner.truth(v); return told === null ? null : !told; }};
    return word === "+" ? inner : {...inner, value: v => -inner.value(v)};
  }
  part() {
    const [digits, name, mark] = this.tokens[this.at] || [], word = this.peek();
    if (digits) {
      this.at++;
      return {value: () => Number(digits), names: new Set(), degree: 0, digits: Number(digits)};
    }
    if (mark === "(" || (name && word in FUNCTIONS)) return this.bracket(FUNCTIONS[word]);
    if (!name || ["and", "or", "not"].includes(word)) this.refuse("a number or a name was expected, found");
    const own = this.known.get(word);
    if (!own) throw Error(`there is nothing of the name '${name}' in this run`);
    this.at++;
    return {value: v => v(own), names: new Set([own]), degree: PLACES.includes(own) ? 1 : 0, name: own};
  }
  bracket(act) {
    if (act) this.at++;
    if (this.peek() !== "(") this.refuse("a bracket was expected, found");
    this.at++;
    const inner = this.climb(0);
    if (this.peek() !== ")") this.refuse("')' was expected before");
    this.at++;
    return act ? {...this.number(inner), value: v => act(inner.value(v)), degree: inner.degree ? Infinity : 0, name: ""} : inner;
  }
  number(part) {
    return part.value ? part : this.refuse("a number was expected, not a comparison, before");
  }
  logical(part) {
    return part.truth ? part : this.refuse("a comparison was expected before");
  }
}

// A number as the page has it (see `plain` in part.py); NaN where it is none.
function known(value) {
  return typeof value === "number" || typeof value === "boolean" ? Number(value) : value === "inf" ? Infinity : value === "-inf" ? -Infinity : NaN;
}

// The values of names in a run, and the places at which a question becomes true.
class Asked {
  constructor(run) {
    this.run = run;
    const numbers = [...run.history].filter(([, {values}]) => values.some(v => v !== null) && values.every(v => v === null || !Number.isNaN(known(v))));
    this.names = new Set([...numbers.map(([name]) => name).filter(name => !COLUMNS.includes(name)), ...PLACES, ...COLUMNS]);
    this.follows = run.row.surface.values.some(v => typeof v === "number") ? ["spindle", "feed"] : [];  // at constant cutting speed: the radius
  }
  question(text) {
    const found = new Question(text, this.names), {lines, lasts} = this.run;
    for (const {left, right} of found.comparisons)  // a line within a block of several lines means the block
      for (const [one, other] of [[left, right], [right, left]])
        if (one.name === "line" && other.digits !== undefined) {
          const block = last(lines[0], other.digits), first = lines[0][block];
          if (block >= 0 && other.digits <= lasts[0][block]) other.value = () => first;
        }
    return found;
  }
  // What names are at a share of an item: of its way, of a rapid that leaves its straight line of its time.
  values(item, share) {
    const {run} = this, row = run.itemRow[item], step = run.itemStep[item], at = row >= 0 ? row : run.before[item] - 1;
    let point, angles;
    const tip = () => point || (point = row < 0 ? run.path.vertex(run.before[item]) : this.loose(item)
      ? run.tool(item, run.begin[item] + share * (run.end[item] - run.begin[item])).point : run.path.point(row, share));
    return name => {
      const axis = "xyz".indexOf(name), turned = "abc".indexOf(name);
      if (axis >= 0) return tip()[axis];
      if (turned >= 0) return (angles || (angles = run.angles(at, row < 0 ? 1 : share) || [0, 0, 0]))[turned];
      if (name === "d") return 2 * tip()[0];
      if (name === "line") return run.lineOf(step);
      if (name === "feed") return row < 0 ? NaN : known(run.feed(row, this.follows.length && tip()));
      if (!COLUMNS.includes(name)) return known(run.history.get(name).value(step));
      return at < 0 ? 0 : name === "spindle" ? run.turning(at, this.follows.length ? tip() : null) : known(run.row[name].value(at));
    };
  }
  loose(item) {
    return this.run.loose.has(this.run.itemRow[item]);
  }
  // The places {item, share} at which a question becomes true, in order, also at the very start.
  moments(question) {
    const {run} = this, along = new Set([...PLACES, ...this.follows]), found = [];
    const spatial = question.comparisons.filter(({names}) => [...names].some(name => along.has(name)));
    let was = false;
    const look = (item, share, place) => {
      const truth = question.tree.truth(this.values(item, share));
      if (truth && !was) found.push({item, share: place});
      if (truth !== null) was = truth;
    };
    for (let item = 0; item < run.items; item++) {
      const row = run.itemRow[item], moves = row >= 0 && run.path.isMotion(row);
      if (!moves || !spatial.length) look(item, moves ? 0 : 1, moves ? 0 : 1);
      else this.cuts(item, spatial).forEach((share, k, all) => {
        look(item, share, share);
        if (k + 1 < all.length) look(item, (share + all[k + 1]) / 2, share);
      });
    }
    return found;
  }
  // Shares of a move, in order, between which no comparison changes: where its two sides become equal, found by halving, and where
  // they come nearest to each other, found by thirds.
  cuts(item, spatial) {
    const {path, rotary: turned} = this.run, row = this.run.itemRow[item], arc = path.arc[row], found = new Set([0, 1]);
    for (const {gap, mixed, names} of spatial) {
      const bent = arc >= 0 || mixed || this.loose(item) || path.bends.has(row) || this.follows.some(name => names.has(name));
      const most = arc >= 0 || turned ? LOOKS : Math.min(LOOKS, Math.max(2, Math.ceil(2 * path.length(row))));
      const n = !bent ? 1 : most * Math.max(1, arc < 0 ? 1 : Math.ceil(Math.abs(path.sweep[arc]) / (Math.PI / 2)));
      const at = share => gap(this.values(item, share)), gaps = new Map();
      for (let k = 0; k <= n; k++) gaps.set(k / n, at(k / n));
      if (n > 1) for (let k = 1; k < n; k++) {
        const [before, here, after] = [k - 1, k, k + 1].map(i => gaps.get(i / n)), sense = Math.sign(here);
        if (!(sense * before >= sense * here && sense * after >= sense * here)) continue;
        let [low, high] = [(k - 1) / n, (k + 1) / n];
        for (let i = 0; i < HALVED; i++) {
          const [a, b] = [low + (high - low) / 3, high - (high - low) / 3];
          if (sense * at(a) < sense * at(b)) high = b; else low = a;
        }
        gaps.set((low + high) / 2, at((low + high) / 2));
      }
      const shares = [...gaps.keys()].sort((a, b) => a - b);
      shares.forEach((share, k) => {
        const next = shares[k + 1], sign = Math.sign(gaps.get(share)), other = Math.sign(gaps.get(next));
        if (n > 1) found.add(share);
        if (next === undefined || !(this.follows.some(name => names.has(name)) ? sign !== other : sign * other < 0)) return;
        let [low, high] = [share, next];
        for (let i = 0; i < HALVED; i++) {
          const middle = (low + high) / 2;
          if (Math.sign(at(middle)) === sign) low = middle; else high = middle;
        }
        found.add(high);
      });
    }
    return [...found].sort((a, b) => a - b);
  }
  // Where the playing stands at a share of an item.
  place({item, share}) {
    const {run} = this, [begin, end] = [run.begin[item], run.end[item]];
    if (share >= 1) return {item, t: end, done: true};
    if (this.loose(item)) return {item, t: begin + share * (end - begin), done: false};
    let [low, high] = [begin, end];
    for (let k = 0; k < HALVED && share > 0; k++) {
      const middle = (low + high) / 2;
      if (run.tool(item, middle).share < share) low = middle; else high = middle;
    }
    return {item, t: share > 0 ? high : begin, done: false};
  }
}
