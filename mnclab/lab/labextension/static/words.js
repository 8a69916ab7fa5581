/* What a word of a part program means: `mnclab.lab.vocabulary` in the browser, where a file has no kernel to ask.

   The words come from words.json, which the declarations of the controls make (tests/lab/test_labextension.py). */
const BACK = 200; // lines that are looked through for what is still on
let table = null;

/** The vocabulary of a control; null for none. Fetched once, when the first word is pointed at. */
export const vocabulary = async control => {
  table = table || fetch(new URL('words.json', import.meta.url)).then(answer => answer.json());
  return (await table)[control] || null;
};

/** The words of a line before its comment: name, begin, end, and the code, if it is one. */
const foundIn = (line, known) => {
  const mark = line.search(new RegExp(known.comment));
  const text = (mark < 0 ? line : line.slice(0, mark)).toUpperCase()
    .replace(/"[^"]*"?|\([^()]*[A-Z]{2}[^()]*\)/g, quoted => ' '.repeat(quoted.length));
  let at = /^\s*\/?(\d+(?=\s))?\s*/.exec(text)[0].length;
  const found = [];
  const pieces = [...text.slice(at).matchAll(/[^\s:]+/g)].slice(0, 4);
  for (let count = pieces.length; count > 0; count--) {
    const name = pieces.slice(0, count).map(piece => piece[0]).join(' ');
    if (!(name in known.codes)) continue;
    const end = at + pieces[count - 1].index + pieces[count - 1][0].length;
    found.push({ name, begin: at, end, code: name });
    at = end;
    break;
  }
  for (const word of text.slice(at).matchAll(/([,#%]?[A-Z]+)(?:[ \t]*(\d+(?:\.\d+)?))?/g)) {
    const [all, letters, number = ''] = word;
    const whole = letters + (/^\d+$/.test(number) ? number.replace(/^0+(?=\d)/, '') : number);
    const names = known.keywords ? (number ? [whole] : []) : [whole, letters];
    const code = names.find(name => name in known.codes) || '';
    found.push({ name: whole, begin: at + word.index, end: at + word.index + all.length, code });
  }
  return found;
};

/** The codes that a word may belong to: those of its block, the nearest first, then what is still on. */
const owners = (lines, column, known) => {
  const far = word => (word.begin > column ? 1e6 : 0) + Math.abs(word.begin - column);
  const here = foundIn(lines[lines.length - 1], known).filter(word => word.code);
  const codes = here.sort((a, b) => far(a) - far(b)).map(word => word.code);
  let block = true;
  for (const line of lines.slice(-BACK, -1).reverse()) {
    const bare = line.split(new RegExp(known.comment), 1)[0].trimEnd();
    block = block && known.joined !== '' && bare.slice(-2).includes(known.joined);
    const found = foundIn(line, known).filter(word => word.code).map(word => word.code).reverse();
    codes.push(...(block ? found : found.filter(code => known.codes[code][2])));
  }
  const letter = code => !known.keywords && /^[A-Z]+$/.test(code); // after a code
  return [...new Set(codes)].sort((a, b) => letter(a) - letter(b));
};

/** The word at a column of the last of some lines: { name, code, says, begin, end }; null for no word. */
export const meaningAt = (lines, column, known) => {
  const word = foundIn(lines[lines.length - 1], known).find(each => each.begin <= column && column < each.end);
  if (!word) return null;
  const { begin, end } = word;
  if (word.name === word.code && (known.keywords || !/^[A-Z]+$/.test(word.name)))
    return { name: word.name, code: word.name, says: known.codes[word.name][0], begin, end };
  for (const name of new Set([word.name, word.name.replace(/[\d.]+$/, '')])) {
    for (const code of owners(lines, column, known)) {
      const says = known.codes[code][1][name];
      if (says) return { name, code, says, begin, end };
    }
    if (known.addresses[name]) return { name, code: '', says: known.addresses[name], begin, end };
    if (known.codes[name]) return { name, code: name, says: known.codes[name][0], begin, end };
  }
  return null;
};

/** A meaning as a sentence: `K depth of one peck, mm (G83 Deep-hole drilling)`. */
export const inWords = (found, known) =>
  `${found.name} ${found.says}` + (found.code && found.code !== found.name ? ` (${found.code} ${known.codes[found.code][0]})` : '');
