/* The editor of mnclab in JupyterLab: its text box becomes an editor of CodeMirror, the one of JupyterLab itself.

   The box stays in the page, hidden: what is typed goes into it, as if it were typed there, and what Python writes into it
   comes back. Faults come with the alarms (data-faults); a click on a move of the picture goes to its line, and the moves
   of the line with the cursor are marked. */
import { inWords, meaningAt, vocabulary } from './words.js';

const STYLE = `
.mnclab-code { border: 1px solid var(--jp-cell-editor-border-color, #9a9a9a); width: 100%; height: 100%; overflow: hidden; }
.mnclab-code .cm-editor { height: 100%; background: var(--jp-layout-color0, #fff); }
.mnclab-code .cm-gutters { color: var(--jp-ui-font-color1, #333); background: var(--jp-layout-color1, #fff); }
.mnclab-alarm, .mnclab-warning { text-decoration: underline wavy 2px; text-underline-offset: 3px; }
.mnclab-alarm { text-decoration-color: var(--jp-error-color1, #b3261e); }
.mnclab-warning { text-decoration-color: var(--jp-warn-color1, #8a5a00); }
.cm-line.mnclab-alarm, .cm-line.mnclab-warning { box-shadow: inset 3px 0 var(--jp-error-color1, #b3261e); }
.mnclab-help strong { color: var(--jp-error-color1, #b3261e); }
.mnclab-help strong.warning { color: var(--jp-warn-color1, #8a5a00); font-weight: normal; }
.mnclab-help { min-height: 1.4em; padding: 2px 0; white-space: normal; color: var(--jp-ui-font-color1, #1a1a1a); }
`;
const MIME = { mnc: 'text/x-mnc', 'tnc-620': 'text/x-klartext', 'nc-31': 'text/x-nc31', g43: 'text/x-g43', 'jnc-t01': 'text/x-jnc' };
let count = 0;

/** Upgrade every editor of mnclab that comes into the page. */
export const watchEditors = ({ services, CodeEditor, view, state, commands, menu }) => {
  const known = new WeakSet();
  const pointed = new Map(); // hosts that the pointer was on, with their views
  const setFaults = state.StateEffect.define();

  /** The ranges of faults in a document: the last letter of a line where a fault lies behind it, the line where it is empty. */
  const marks = (faults, doc) => {
    const ranges = faults.filter(fault => fault.line <= doc.lines).map(fault => {
      const line = doc.line(fault.line);
      const from = Math.max(line.from, Math.min(line.from + fault.column - 1, line.to - 1));
      const to = Math.max(from, Math.min(from + fault.length, line.to));
      const look = { class: `mnclab-${fault.severity}`, fault };
      return to > from ? view.Decoration.mark(look).range(from, to) : view.Decoration.line(look).range(line.from);
    });
    return view.Decoration.set(ranges, true);
  };
  const faultsField = state.StateField.define({
    create: () => view.Decoration.none,
    update: (old, change) => {
      const told = change.effects.find(effect => effect.is(setFaults));
      return told ? marks(told.value, change.state.doc) : old.map(change.changes);
    },
    provide: field => view.EditorView.decorations.from(field),
  });
  /** The faults from a place of a text to another, the alarms first. */
  const faultsIn = (shown, from, to) => {
    const found = [];
    shown.field(faultsField).between(from, to, (begin, end, { spec: { fault } }) => { found.push({ ...fault, begin, end }); });
    return found.sort((a, b) => a.severity.localeCompare(b.severity));
  };
  const faultHover = view.hoverTooltip((shown, at) => {
    const [fault] = faultsIn(shown.state, at, at);
    const dom = Object.assign(document.createElement('div'), { className: 'mnclab-word', textContent: fault?.message });
    return fault ? { pos: fault.begin, end: fault.end, above: true, create: () => ({ dom }) } : null;
  });
  let last = null; // the editor that had the cursor last, with the page it stands in
  document.addEventListener('focusin', ({ target }) => {
    if (target.closest?.('.cm-editor')) last = edited.get(target.closest('.mnclab-code')) || null;
  });
  const edited = new WeakMap();
  for (const act of ['undo', 'redo']) {
    const id = `mnclab:${act}`;
    commands.addCommand(id, { label: act === 'undo' ? 'Undo' : 'Redo', execute: () => last[act]() });
    menu?.editMenu.undoers[act].add({ id, rank: 0, isEnabled: widget => !!last && widget.node.contains(last.host) });
  }

  const upgrade = area => {
    const root = area.closest('.mnclab-live');
    if (!root) return;
    const host = document.createElement('div');
    const help = document.createElement('div');
    host.className = 'mnclab-code';
    host.setAttribute('data-lm-suppress-shortcuts', 'true'); // Ctrl+S is ours here, and letters are letters
    help.className = 'mnclab-help';
    help.id = `mnclab-help-${++count}`;
    area.style.display = 'none';
    area.parentElement.style.overflow = 'visible';
    area.after(host);
    area.parentElement.after(help);

    const native = Object.getOwnPropertyDescriptor(HTMLTextAreaElement.prototype, 'value');
    const model = new CodeEditor.Model({ mimeType: MIME[root.querySelector('[data-control]')?.dataset.control] || 'text/plain' });
    model.sharedModel.setSource(area.value);
    model.sharedModel.clearUndoHistory(); // the text that it begins with stays
    let line = 0;
    const moved = update => {
      if (update.docChanged && update.state.doc.toString() !== native.get.call(area)) {
        native.set.call(area, update.state.doc.toString());
        area.dispatchEvent(new Event('input', { bubbles: true }));
      }
      if (update.docChanged || update.selectionSet) here(update.view);
    };
    const name = { 'aria-label': root.querySelector('.mnclab-editor label').textContent, 'aria-describedby': help.id };
    const editor = services.factoryService.newDocumentEditor({
      host, model, config: { lineNumbers: true, lineWrap: false, scrollPastEnd: false },
      extensions: [faultsField, faultHover, view.EditorView.updateListener.of(moved), view.EditorView.contentAttributes.of(name)],
    });
    const shown = editor.editor;
    edited.set(host, editor);
    host.addEventListener('pointerenter', () => pointed.set(host, shown));
    shown.setTabFocusMode?.(true); // Tab leaves the editor; programs have no tabs
    Object.defineProperty(area, 'value', {
      get: () => native.get.call(area),
      set: text => {
        native.set.call(area, text);
        if (shown.state.doc.toString() !== text) model.sharedModel.setSource(text);
      },
    });

    /** Say what is wrong in the line of the cursor, or first of all, and what its word means; mark the moves of the line. */
    const here = async at => {
      const { head } = at.state.selection.main;
      const on = at.state.doc.lineAt(head);
      mark(on.number);
      const [fault] = [...faultsIn(at.state, on.from, on.to), ...faultsIn(at.state, 0, at.state.doc.length)];
      const wrong = Object.assign(document.createElement('strong'), { className: fault?.severity ?? '',
        textContent: fault ? `line ${at.state.doc.lineAt(fault.begin).number}: ${fault.message} ` : '' });
      help.replaceChildren(wrong);
      const words = await vocabulary(root.querySelector('[data-control]')?.dataset.control);
      if (!words || at.state.selection.main.head !== head) return;
      const lines = at.state.doc.sliceString(0, on.to).split('\n');
      const found = meaningAt(lines, head - on.from, words) || meaningAt(lines, Math.max(head - on.from - 1, 0), words);
      help.replaceChildren(wrong, found ? inWords(found, words) : '');
    };
    const mark = number => {
      line = number;
      root.querySelectorAll('.mnclab-moves g').forEach(
        each => each.classList.toggle('here', !each.dataset.program && each.dataset.line === String(line)));
    };
    const told = () => {
      const verdict = root.querySelector('[data-faults]');
      if (!verdict) return;
      const mime = MIME[verdict.dataset.control];
      if (mime && model.mimeType !== mime) model.mimeType = mime;
      shown.dispatch({ effects: setFaults.of(JSON.parse(verdict.dataset.faults)) });
      here(shown);
    };
    /** Through a box of its own: a click on the button would overtake what was typed last. */
    const send = sign => {
      const kept = root.querySelector('.mnclab-kept textarea');
      kept.value = sign + shown.state.doc.toString();
      kept.dispatchEvent(new Event('input', { bubbles: true }));
    };
    const watch = (selector, done) => {
      const part = root.querySelector(selector);
      if (part) new MutationObserver(done).observe(part, { childList: true, subtree: true });
    };
    watch('.mnclab-alarms', told);
    watch('.mnclab-picture', () => mark(line));
    told();
    host.addEventListener('keydown', event => {
      const key = (event.shiftKey ? 'shift ' : '') + event.key.toLowerCase();
      const act = { s: () => send('='), z: () => editor.undo(), 'shift z': () => editor.redo(), y: () => editor.redo() }[key];
      if (!act || !(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      act();
    });
    root.addEventListener('click', event => {
      const button = event.target.closest?.('.mnclab-save, .mnclab-grade-box:not(div)');
      if (!button) return;
      event.stopPropagation();
      send(button.matches('.mnclab-save') ? '=' : '!');
    }, true);
    root.addEventListener('click', event => {
      const move = event.target.closest?.('.mnclab-moves g');
      if (!move || move.dataset.program) return;
      const wanted = shown.state.doc.line(Math.min(Number(move.dataset.line), shown.state.doc.lines));
      shown.dispatch({ selection: { anchor: wanted.from, head: wanted.to }, scrollIntoView: true });
      shown.focus();
    });
  };

  const look = () => {
    for (const [host, shown] of pointed) if (!host.isConnected) { // its hover help hangs elsewhere in the page
      pointed.delete(host);
      shown.dispatch({ effects: view.closeHoverTooltips });
    }
    document.querySelectorAll('.mnclab-editor textarea').forEach(area => {
      if (known.has(area)) return;
      known.add(area);
      upgrade(area);
    });
  };
  document.head.append(Object.assign(document.createElement('style'), { textContent: STYLE }));
  new MutationObserver(look).observe(document.body, { childList: true, subtree: true });
  look();
};
