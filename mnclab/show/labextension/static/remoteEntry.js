/* Colours for part programs in JupyterLab: in files, and in cells that begin with %%mnc.

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
  const KLARTEXT =
    /(BEGIN|END) PGM|BLK FORM( 0\.[12])?|TOOL (CALL|DEF)|CYCL (DEF|CALL)( \d+(\.\d+)?)?|TCH PROBE( \d+(\.\d+)?)?|CALL (LBL|PGM)|LBL|REP|(APPR|DEP) (LT|LN|CT|LCT|PLT|PLN|PCT|PLCT)|FN ?\d+ ?:|F(LT|CT|L|C|POL)\b|(CTP|CC|CR|CT|CP|LP|LN|L|C|RND|CHF|STOP|PLANE( \w+)?|SEL \w+|PATTERN DEF|CONTOUR DEF|GLOBAL DEF|IF|GOTO|EQU|NE|GT|LT)(?![\w=])/iy;
  const LANGUAGES = [
    {
      name: 'MNC', mime: 'text/x-mnc', extensions: ['mnc', 'nc', 'ngc'],
      rules: [[/\/\/.*|;.*|\(.*?\)/y, 'comment'], [/%\S*/y, 'meta'], ...WORDS],
    },
    {
      name: 'NC-31 (lathe)', mime: 'text/x-nc31', extensions: ['nc31'],
      rules: [[/;.*/y, 'comment'], ...WORDS],
    },
    {
      name: 'Klartext (TNC)', mime: 'text/x-klartext', extensions: ['klartext'],
      rules: [
        [/\s+/y, null],
        [/;.*/y, 'comment'],
        [/^\s*\*\s.*/y, 'heading'],
        [/"[^"]*"/y, 'string'],
        [/^\s*\d+(?=\s)/y, 'labelName'],
        [KLARTEXT, 'keyword'],
        [/M\d+\b/iy, 'controlKeyword'],
        [/Q[LRS]?\d+/iy, 'variableName.special'],
        [/(FMAX|FAUTO|RL|RR|R0|DR[-+]|MM|INCH)(?![\w=])|[XYZ](?=\s|$)/iy, 'atom'],
        [/(SIN|COS|TAN|ASIN|ACOS|ATAN|SQRT|SQ|LN|LOG|EXP|NEG|ABS|INT|FRAC|SGN|PI|DIV)\b/iy, 'operatorKeyword'],
        [/[SF](?=\s*[-+Q\d.])/iy, 'typeName'],
        [/I?[A-Z]+(?=\s*[-+Q\d.,])/iy, 'propertyName'],
        [NUMBER, 'number'],
        [/[-+*/^()=~]/y, 'operator'],
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
    if (/^(nc-31|jnc)/.test(control)) return 'text/x-nc31';
    return !control && /^\s*(\d+\s+)?BEGIN PGM\b/m.test(text) ? 'text/x-klartext' : 'text/x-mnc';
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

  const plugin = ({ IEditorLanguageRegistry }, { LanguageSupport, StreamLanguage }, { INotebookTracker }, { IEditorTracker }) => ({
    id: 'mnclab:languages',
    description: 'Colours for part programs of CNC controls',
    autoStart: true,
    requires: [IEditorLanguageRegistry],
    optional: [INotebookTracker, IEditorTracker],
    activate: (app, languages, notebooks, editors) => {
      for (const { name, mime, extensions, rules } of LANGUAGES) {
        const support = new LanguageSupport(StreamLanguage.define({ name, token: tokenOf(rules) }));
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
    },
  });

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
      const names = ['@jupyterlab/codemirror', '@codemirror/language', '@jupyterlab/notebook', '@jupyterlab/fileeditor'];
      const made = plugin(...(await Promise.all(names.map(load))));
      return () => ({ __esModule: true, default: made });
    },
  };
})();
