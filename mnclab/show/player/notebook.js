// Tells the frames of a notebook whether its theme is dark (JupyterLab, VS Code), when they ask and when it changes.
// Where the scripts of outputs do not run, a page follows the system's choice.
if (!window.mnclabPlayers) {
  window.mnclabPlayers = true;
  const dark = () => document.body.dataset.jpThemeLight === "false" || document.body.classList.contains("vscode-dark");
  const known = () => "jpThemeLight" in document.body.dataset || document.body.className.includes("vscode-");
  const tell = frame => known() && frame.postMessage({mnclab: dark() ? "dark" : "light"}, "*");
  addEventListener("message", event => event.data && event.data.mnclab === "theme?" && tell(event.source));
  new MutationObserver(() => document.querySelectorAll("iframe.mnclab-player").forEach(each => tell(each.contentWindow)))
    .observe(document.body, {attributes: true, attributeFilter: ["class", "data-jp-theme-light"]});
}
