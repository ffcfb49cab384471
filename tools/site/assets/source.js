// source.js - a page of a source takes the colours that the site was last read in.
(() => {
  const root = new URL(document.currentScript.dataset.root, location.href);
  try {
    const kept = JSON.parse(localStorage.getItem(`${root.pathname}.__palette`));
    if (kept?.color?.scheme) document.documentElement.dataset.scheme = kept.color.scheme;
  } catch {
    // Without storage the system's choice holds.
  }
})();
