// math.js - sets the formulas of a page, with the KaTeX in this folder.
(() => {
  const formulas = [...document.querySelectorAll('.arithmatex')];
  if (!formulas.length) return;
  const base = new URL('katex/', document.currentScript.src);

  const style = document.createElement('link');
  style.rel = 'stylesheet';
  style.href = new URL('katex.min.css', base);
  document.head.append(style);

  const script = document.createElement('script');
  script.src = new URL('katex.min.js', base);
  script.onload = () => {
    for (const element of formulas) {
      const text = element.textContent.trim();
      const displayMode = text.startsWith('\\[');
      katex.render(text.slice(2, -2), element, { displayMode, throwOnError: false, strict: false });
    }
    document.body.dataset.math = 'set';
  };
  document.head.append(script);
})();
