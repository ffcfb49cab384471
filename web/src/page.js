// Functions that create elements of the page, and its icons.

export function element(tag, attributes, ...children) {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes ?? {}))
    if (value !== null && value !== undefined) out.setAttribute(name, value);
  out.append(...children.filter((c) => c !== null && c !== undefined));
  return out;
}

// Returns a name that a line may break behind its dots and underscores.
export const breakable = (name) => name.split(/(?<=[._])/).flatMap((part, i) => (i ? [element('wbr'), part] : [part]));

// Returns a text whose parts in `back quotes` are code.
export const with_code = (text) => text.split('`').map((part, i) => (i % 2 ? element('code', {}, part) : part));

export const by_id = (id) => document.getElementById(id);

// Returns a button that calls `does` with the event and the button.
export function button(attributes, does, ...children) {
  const out = element('button', { type: 'button', ...attributes }, ...children);
  out.addEventListener('click', (event) => does(event, out));
  return out;
}

// Calls `does` when the element with this id is clicked.
export const on_click = (id, does) => by_id(id).addEventListener('click', does);

// Returns a link to a section of the page.
export const chip = (id, words, kind = '') => element('a', { href: `#${id}`, class: `chip ${kind}` }, words);

// Starts a page: `make` returns what scripts that take pictures and tests use as window.sinew.
export async function start_page(make) {
  try {
    window.sinew = await make(JSON.parse(by_id('run-data').textContent));
    document.documentElement.dataset.ready = 'yes';
  } catch (error) {
    document.body.prepend(element('p', { class: 'failed', role: 'alert' }, `This page could not be read: ${error.message}`));
    throw error;
  }
}

const paths = {
  play: 'M7 4.5v15l12-7.5z',
  pause: 'M7 5h3.6v14H7zM13.4 5H17v14h-3.6z',
  back: 'M18 5v14l-9-7zM6 5h2.4v14H6z',
  forth: 'M6 5v14l9-7zM15.6 5H18v14h-2.4z',
  light: 'M12 7a5 5 0 1 0 0 10 5 5 0 0 0 0-10zM11 1h2v3h-2zM11 20h2v3h-2zM1 11h3v2H1zM20 11h3v2h-3zM4 5.4 5.4 4l2.1 2.1-1.4 1.4zM16.5 17.9l1.4-1.4L20 18.6 18.6 20zM4 18.6l2.1-2.1 1.4 1.4L5.4 20zM16.5 6.1 18.6 4 20 5.4l-2.1 2.1z',
  enlarge: 'M4 4h7v2H7.4l4.3 4.3-1.4 1.4L6 7.4V11H4zM20 20h-7v-2h3.6l-4.3-4.3 1.4-1.4L18 16.6V13h2z',
  shrink: 'M11 11H4V9h3.6L3.3 4.7l1.4-1.4L9 7.6V4h2zM13 13h7v2h-3.6l4.3 4.3-1.4 1.4L15 16.4V20h-2z',
  dark: 'M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z',
};

export function set_icon(button, name) {
  button.innerHTML = `<svg viewBox="0 0 24 24" width="18" height="18" aria-hidden="true"><path fill="currentColor" d="${paths[name]}"/></svg>`;
}
