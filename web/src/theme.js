// Colors and fonts of the page, by the names of style.css.
const names = ['paper', 'ink', 'quiet', 'edge', 'grid', 'accent', 'stance', 'fault', 'bad', 'warn', 'mark', 'rail', 'rail-stance',
  'rail-swing', 'metal', 'metal-edge', 'ground', 'ground-edge', 'tendon', 'actual', 'desired', 'force', 'inlet', 'exhaust', 'unlit', 'sans'];

// Returns the current colors, those of lines as `lines`, the font of axes, and whether the page is dark.
export function page_theme() {
  const css = getComputedStyle(document.documentElement), of = (name) => css.getPropertyValue(`--${name}`).trim();
  const out = Object.fromEntries(names.map((name) => [name, of(name)]));
  return { ...out, lines: [0, 1, 2, 3, 4, 5, 6, 7].map((i) => of(`line-${i}`)), font: `11px ${out.sans}`, dark: css.colorScheme === 'dark' };
}

// Returns the colors of a picture for print: the light ones.
export const paper_theme = () => ({ ...theme_of('light'), paper: '#fff' });

// Returns the colors of the theme 'light' or 'dark', whichever the page has now.
export function theme_of(name) {
  const root = document.documentElement, before = root.dataset.theme;
  root.dataset.theme = name;
  try {
    return page_theme();
  } finally {
    if (before) root.dataset.theme = before;
    else delete root.dataset.theme;
  }
}
