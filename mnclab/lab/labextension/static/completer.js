/* The list of words that may be typed next, in JupyterLab: what mnclab offers stands there as it is written, with an icon of its
   kind, and without the words that JupyterLab picks up in the notebook.

   The kernel marks its offers by the first letter of what JupyterLab calls their type (`KINDS` of mnclab/lab/magic.py). */
const KINDS = { '◆': 'code', '◇': 'word', '▤': 'name' };
const STYLE = `
.jp-Completer-typeExtended { white-space: nowrap; } /* a meaning of several words beside a code */
.jp-Completer-item .mnclab-kind { background: transparent; font-size: 15px; }
.mnclab-kind[data-kind=code] { color: #b8500c; }
.mnclab-kind[data-kind=word] { color: #1565c0; }
.mnclab-kind[data-kind=name] { color: #5f6368; }
.jp-Completer-item.jp-mod-active .mnclab-kind { color: inherit; }
`;
const kindOf = item => KINDS[item.type?.[0]];

/** Let the completer of JupyterLab (its module) show these; `isProgram` says whether an editor holds a part program. */
export const showWords = ({ Completer, ProviderReconciliator }, isProgram) => {
  document.head.append(Object.assign(document.createElement('style'), { textContent: STYLE }));
  const { createCompletionItemNode: made } = Completer.Renderer.prototype;
  Completer.Renderer.prototype.createCompletionItemNode = function (item, types) {
    const node = made.call(this, item, types);
    const kind = kindOf(item);
    if (!kind) return node;
    const [icon, said] = [node.firstElementChild, node.querySelector('.jp-Completer-typeExtended')];
    icon.classList.add('mnclab-kind');
    icon.dataset.kind = kind;
    icon.dataset.colorIndex = '0';
    icon.setAttribute('aria-label', kind);
    node.title = said.textContent = item.type.slice(1).trim(); // JupyterLab writes it in small letters
    return node;
  };
  const { fetch } = ProviderReconciliator.prototype;
  ProviderReconciliator.prototype.fetch = async function (...request) {
    const found = await fetch.apply(this, request);
    const ours = found?.items.filter(kindOf) ?? [];
    if (ours.length) return { ...found, items: ours };
    return isProgram(this._context?.editor) ? null : found;
  };
};
