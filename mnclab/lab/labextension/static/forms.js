/* The forms of mnclab in JupyterLab: Python is told which field has the cursor, and lights up in the picture what it measures. */

/** Watch the fields of all forms, and name the handles of their sliders. */
export const watchForms = () => {
  document.addEventListener('focusin', event => {
    const row = event.target.closest?.('.mnclab-form .mnclab-row');
    const asked = row?.closest('.mnclab-form').querySelector('.mnclab-asked input');
    const place = /\bmnclab-p(\d+)\b/.exec(row?.className)?.[1];
    if (!asked || asked.value === place) return;
    asked.value = place;
    asked.dispatchEvent(new Event('input', { bubbles: true }));
  });
  const name = () => document.querySelectorAll('.mnclab-row .noUi-handle:not([aria-label])').forEach(
    handle => handle.setAttribute('aria-label', handle.closest('.mnclab-row').querySelector('label').textContent));
  new MutationObserver(name).observe(document.body, { childList: true, subtree: true });
  name();
};
