// source.js - a page of a source or of the C++ reference takes the colours that the site was last read in.
(() => {
  const root = new URL(document.currentScript.dataset.root, location.href);
  try {
    const kept = JSON.parse(localStorage.getItem(`${root.pathname}.__palette`));
    const scheme = kept?.color?.scheme;
    if (scheme) document.documentElement.dataset.scheme = scheme;
    if (scheme) document.documentElement.classList.add(scheme === 'slate' ? 'dark-mode' : 'light-mode');
  } catch {
    // Without storage the system's choice holds.
  }
})();
