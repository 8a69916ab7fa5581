/* Part programs in JupyterLab: colours and the meaning of words, in files and in cells that begin with %%mnc; the editor.

   Written by hand, no build: this is what JupyterLab asks of an extension at run time. `init` gets the modules that all
   extensions share, `get` hands over the plugin. A language is a list of [pattern, token] tried at each place of a
   line; the tokens are names of CodeMirror's highlighting tags. */
(() => {
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

  /** The language of a cell that begins with %%mnc: what its options say, or what its text looks like. */
  const languageOfCell = text => {
    if (!/^%%mnc\b/.test(text)) return null;
    const control = (/--control[ =]+["']?([\w-]+)/.exec(text.split('\n', 1)[0]) || [])[1] || '';
    if (/^tnc/.test(control)) return 'text/x-klartext';
    if (/^nc-31/.test(control)) return 'text/x-nc31';
    if (/^jnc/.test(control)) return 'text/x-jnc';
    if (/^g43/.test(control)) return 'text/x-g43';
    return !control && /^\s*(\d+\s+)?BEGIN PGM\b/im.test(text) ? 'text/x-klartext' : 'text/x-mnc';
  };

  const watchCell = (model, notebook) => {
    if (model.type !== 'code' || watched.has(model)) return;
    watched.add(model);
    const update = () => {
      const wanted = languageOfCell(model.sharedModel.getSource());
      const ours = LANGUAGES.some(language => language.mime === model.mimeType);
      if (wanted ? model.mimeType !== wanted : ours) model.mimeType = wanted || notebook.codeMimetype;
    };
    model.contentChanged.connect(update);
    model.mimeTypeChanged.connect(update); // the kernel sets the language of all cells when it starts
    update();
  };
  const watched = new WeakSet();

  const watchNotebook = panel => {
    const all = () => [...panel.content.model.cells].forEach(model => watchCell(model, panel.content));
    panel.context.ready.then(() => {
      panel.content.model.cells.changed.connect(all);
      all();
    });
  };

  /** The suffix .h is that of C headers too: only a text that begins like a program of a TNC is coloured as one. */
  const watchFile = widget => {
    widget.context.ready.then(() => {
      const model = widget.content.model;
      const update = () => {
        const text = model.sharedModel.getSource();
        const wanted = 'text/x-klartext';
        if (/\.h$/i.test(widget.context.path) && /^\s*(\d+\s+)?BEGIN PGM\b/i.test(text) && model.mimeType !== wanted)
          model.mimeType = wanted;
      };
      model.mimeTypeChanged.connect(update);
      update();
    });
  };

  const plugin = (
    { IEditorLanguageRegistry }, { HighlightStyle, LanguageSupport, StreamLanguage, syntaxHighlighting },
    { INotebookTracker }, { IEditorTracker }, { CodeEditor, IEditorServices }, view, state, { tags }, { hover }, { watchEditors },
  ) => ({
    id: 'mnclab:languages',
    description: 'Colours, words and the editor for part programs of CNC controls',
    autoStart: true,
    requires: [IEditorLanguageRegistry, IEditorServices],
    optional: [INotebookTracker, IEditorTracker],
    activate: (app, languages, services, notebooks, editors) => {
      // that of JupyterLab is too dim on a dark page
      const grey = 'color-mix(in srgb, #408080 65%, var(--jp-content-font-color0, #000)) !important';
      const readable = HighlightStyle.define([{ tag: tags.comment, color: grey, fontStyle: 'italic' }]);
      for (const { name, control, mime, extensions, rules } of LANGUAGES) {
        const language = StreamLanguage.define({ name, token: tokenOf(rules) });
        const support = new LanguageSupport(language, [hover(view, control), syntaxHighlighting(readable)]);
        languages.addLanguage({ name, displayName: name, mime, extensions, support });
        app.docRegistry.addFileType({
          name: mime.replace('text/x-', ''), displayName: name, mimeTypes: [mime],
          extensions: extensions.map(suffix => '.' + suffix), fileFormat: 'text', contentType: 'file',
        });
      }
      if (notebooks) {
        notebooks.forEach(watchNotebook);
        notebooks.widgetAdded.connect((_, panel) => watchNotebook(panel));
      }
      if (editors) {
        editors.forEach(watchFile);
        editors.widgetAdded.connect((_, widget) => watchFile(widget));
      }
      watchEditors({ services, CodeEditor, view, state });
    },
  });

  const beside = name => import(new URL(name, here));
  const here = document.currentScript.src;
  let shared = {};
  const load = async name => {
    const versions = Object.values(shared[name] || {});
    if (!versions.length) throw new Error(`mnclab: JupyterLab does not share ${name}`);
    return (await versions[versions.length - 1].get())();
  };
  window._JUPYTERLAB = window._JUPYTERLAB || {};
  window._JUPYTERLAB.mnclab = {
    init: scope => { shared = scope; },
    get: async () => {
      const names = [
        '@jupyterlab/codemirror', '@codemirror/language', '@jupyterlab/notebook', '@jupyterlab/fileeditor',
        '@jupyterlab/codeeditor', '@codemirror/view', '@codemirror/state', '@lezer/highlight',
      ];
      const made = plugin(...(await Promise.all([...names.map(load), beside('hover.js'), beside('editor.js')])));
      return () => ({ __esModule: true, default: made });
    },
  };
})();
