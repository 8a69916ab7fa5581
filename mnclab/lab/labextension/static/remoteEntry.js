/* Part programs in JupyterLab: colours and the meaning of words, in files and in cells that begin with %%mnc; the editor.

   Written by hand, no build: this is what JupyterLab asks of an extension at run time. `init` gets the modules that all
   extensions share, `get` hands over the plugin. The languages stand in languages.js. */
(() => {
  let LANGUAGES = [];

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
    { INotebookTracker }, { IEditorTracker }, { IMainMenu }, { CodeEditor, IEditorServices }, view, state, { tags }, completer,
    { hover }, { watchEditors }, { watchForms }, { showWords }, { tokenOf },
  ) => ({
    id: 'mnclab:languages',
    description: 'Colours, words and the editor for part programs of CNC controls',
    autoStart: true,
    requires: [IEditorLanguageRegistry, IEditorServices],
    optional: [INotebookTracker, IEditorTracker, IMainMenu],
    activate: (app, languages, services, notebooks, editors, menu) => {
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
      watchEditors({ services, CodeEditor, view, state, commands: app.commands, menu });
      watchForms();
      showWords(completer, editor => LANGUAGES.some(language => language.mime === editor?.model.mimeType));
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
        '@jupyterlab/codemirror', '@codemirror/language', '@jupyterlab/notebook', '@jupyterlab/fileeditor', '@jupyterlab/mainmenu',
        '@jupyterlab/codeeditor', '@codemirror/view', '@codemirror/state', '@lezer/highlight', '@jupyterlab/completer',
      ];
      const files = ['hover.js', 'editor.js', 'forms.js', 'completer.js', 'languages.js'].map(beside);
      ({ LANGUAGES } = await files[files.length - 1]);
      const made = plugin(...(await Promise.all([...names.map(load), ...files])));
      return () => ({ __esModule: true, default: made });
    },
  };
})();
