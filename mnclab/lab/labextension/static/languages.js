/* The languages of part programs, for the colours of JupyterLab and of the player. A language is a list of [pattern, token]
   tried at each place of a line; the tokens are names of CodeMirror's highlighting tags. */
const NUMBER = /[-+]?(\d+[.,]?\d*|[.,]\d+)/y;
const WORDS = [
  [/\s+/y, null],
  [/N\s*\d+|^\s*\d+(?=\s)/iy, 'labelName'],
  [/G\s*\d+(\.\d+)?/iy, 'keyword'],
  [/M\s*\d+/iy, 'controlKeyword'],
  [/[TSF]\s*(?=[-+\d.@])/iy, 'typeName'],
  [/[A-Z](?=\s*[-+\d.@~])/iy, 'propertyName'],
  [NUMBER, 'number'],
  [/[~*@]/y, 'operator'],
  [/\/(?!\/)/y, 'meta'],
];
/** Klartext: the words that begin a block, the longer before the shorter; C and L are axes and lengths elsewhere. */
const BLOCKS = new RegExp('(?<=^\\s*/?(\\d+\\s+)?/?)(' + [
  '(BEGIN|END) +PGM', 'BLK +FORM( +(0\\.[12]|CYLINDER|ROTATION|FILE))?', 'TOOL +(CALL|DEF)', 'CYCL +DEF( +\\d+(\\.\\d+)?)?',
  'CYCL +CALL( +(POS|PAT))?', 'TCH +PROBE( +\\d+(\\.\\d+)?)?', 'CALL +(LBL|PGM|SELECTED +PGM)', 'SEL +(PGM|PATTERN|CONTOUR|TABLE)',
  'PATTERN +DEF', 'CONTOUR +DEF', 'GLOBAL +DEF( +\\d+)?', 'DECLARE +(STRING|CONTOUR)', 'TRANS +DATUM( +(AXIS|TABLE|RESET))?',
  'FUNCTION( +[A-Z-]+)?', 'PLANE( +[A-Z]+)?', '(APPR|DEP) +(PLCT|PLT|PLN|PCT|LCT|LT|LN|CT)', 'FN *\\d+ *:?',
  'FSELECT', 'FPOL', 'FLT', 'FCT', 'FL', 'FC', 'CTP', 'CC', 'CR', 'CT', 'CP', 'LP', 'LN', 'L', 'C', 'STOP',
].join('|') + ')(?![A-Z_=])', 'iy');
const INSIDE = /(IF|GOTO|EQU|NE|GT|LT|(IS )?(UN)?DEFINED|PREDEF|SCREEN)(?![\w=])|(LBL|RND|CHF|REP)(?![A-Z_=])/iy;
const ISO = comment => [[comment, 'comment'], [/%\S*/y, 'meta'], ...WORDS];
const LANGUAGES = [
  { name: 'MNC', control: 'mnc', mime: 'text/x-mnc', extensions: ['mnc'], rules: ISO(/\/[ \t]?\/.*/y) },
  { name: 'ISO (G43)', control: 'g43', mime: 'text/x-g43', extensions: ['g43', 'iso', 'nc', 'ngc'], rules: ISO(/;.*|\(.*?\)/y) },
  { name: 'NC-31 (lathe)', control: 'nc-31', mime: 'text/x-nc31', extensions: ['nc31'], rules: [[/;.*/y, 'comment'], ...WORDS] },
  { name: 'DIN/ISO (TNC)', control: 'tnc-620', mime: 'text/x-din-iso', extensions: ['i'], rules: ISO(/;.*/y) },
  { name: 'JNC-T01 (lathe)', control: 'jnc-t01', mime: 'text/x-jnc', extensions: ['jnc'], rules: ISO(/'.*/y) },
  {
    name: 'Klartext (TNC)', control: 'tnc-620', mime: 'text/x-klartext', extensions: ['klartext'],
    rules: [
      [/\s+/y, null],
      [/;.*/y, 'comment'],
      [/^\s*(\d+\s+)?\*\s.*/y, 'heading'],
      [/"[^"]*"?|'[^']*'?|(?<=\bPGM\s+)(?!QS?\d)[^\s;"']+/iy, 'string'], // names of programs too
      [/^\s*\d+(?=\s)/y, 'labelName'],
      [BLOCKS, 'keyword'],
      [INSIDE, 'keyword'],
      [/M\s?\d+\b/iy, 'controlKeyword'],
      [/Q[LRS]?\s?\d+/iy, 'variableName.special'],
      [/(FMAX|F\s?AUTO|F\s?MAX|RL|RR|R0|DR[-+]|CLSD[-+]|MM|INCH)(?![\w=.])|[XYZ](?=\s|$)/iy, 'atom'],
      [/(SIN|COS|TAN|ASIN|ACOS|ATAN|SQRT|SQ|LN|LOG|EXP|NEG|ABS|INT|FRAC|SGN|PI|DIV|ANG)\b/iy, 'operatorKeyword'],
      [/(LEN(?!\s*[-+]?\s?\d)|TOCHAR|TONUMB|SUBSTR|INSTR|STRLEN|STRCOMP|SYSSTR)\b/iy, 'operatorKeyword'],
      [/(FU|FZ|[SF])(?=\s*[-+]?\s*(Q[LR]?\s?\d|[\d.]))/iy, 'typeName'],
      [/I?(P[123][XY]|[A-Z]+)(?=[-+]?Q[LR]?\s?\d|\s*[-+]?\s?[.,]?\d|[-+])/iy, 'propertyName'],
      [NUMBER, 'number'],
      [/[-+*/^()=~|]/y, 'operator'],
      [/[A-Z_][\w.:-]*/iy, null], // a name, whole: no letter of it is a word
    ],
  },
];

/** What a stream of CodeMirror reads next, by the rules of a language. */
const tokenOf = rules => stream => {
  if (stream.sol() && stream.match(/^%%\w.*/)) return 'meta'; // the magic of a cell
  for (const [pattern, token] of rules) {
    pattern.lastIndex = stream.pos;
    const found = pattern.exec(stream.string);
    if (found && found[0]) {
      stream.pos += found[0].length;
      return token;
    }
  }
  stream.next();
  return null;
};

export { LANGUAGES, tokenOf };
