/* A word of a part program that the pointer rests on says what it means: in files, in %%mnc cells, in the editor. */
import { inWords, meaningAt, vocabulary } from './words.js';

const STYLE = `
.mnclab-word { padding: 4px 8px; max-width: 40em; color: var(--jp-ui-font-color1); background: var(--jp-layout-color1); }
`;
document.head.append(Object.assign(document.createElement('style'), { textContent: STYLE }));

/** What CodeMirror asks for a place of a text in the language of a control. */
export const hover = (view, control) => view.hoverTooltip(async (shown, at) => {
  const known = await vocabulary(control);
  const line = shown.state.doc.lineAt(at);
  if (!known || line.text.startsWith('%%')) return null;
  const lines = shown.state.doc.sliceString(0, line.to).split('\n');
  const found = meaningAt(lines, at - line.from, known);
  if (!found) return null;
  const dom = document.createElement('div');
  dom.className = 'mnclab-word';
  dom.textContent = inWords(found, known);
  return { pos: line.from + found.begin, end: line.from + found.end, above: true, create: () => ({ dom }) };
});
