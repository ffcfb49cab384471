// Menu of a button. Arrow keys move through it; Escape and a click elsewhere close it.
import { element } from './page.js';

let open = null;

export function close_menu(back = false) {
  if (!open) return;
  const { root, button } = open;
  open = null;
  root.remove();
  button.setAttribute('aria-expanded', 'false');
  if (back) button.focus();
}

function key(event) {
  const items = [...open.root.querySelectorAll('button:not(:disabled)')], at = items.indexOf(document.activeElement);
  const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: -1 }[event.key];
  if (to !== undefined) items.at(to % items.length)?.focus();
  else if (event.key === 'Escape') close_menu(true);
  else if (event.key === 'Tab') return close_menu();
  else if (![' ', 'Enter'].includes(event.key)) return;
  event.stopPropagation();
  if (to !== undefined || event.key === 'Escape') event.preventDefault();
}

// `entries`: [words, does] for an item, or a string for a heading. A second click on the button closes
// the menu.
export function open_menu(button, entries) {
  const again = open?.button === button;
  close_menu();
  if (again) return;
  const items = entries.filter(Boolean).map((entry) => {
    if (typeof entry === 'string') return element('p', { class: 'quiet' }, entry);
    const item = element('button', { type: 'button', role: 'menuitem' }, entry[0]);
    item.addEventListener('click', (event) => {
      event.stopPropagation();
      close_menu(true);
      entry[1]();
    });
    return item;
  });
  const root = element('div', { class: 'menu no-print', role: 'menu' }, ...items);
  root.addEventListener('keydown', key);
  button.setAttribute('aria-expanded', 'true');
  button.after(root);
  open = { root, button };
  // Keeps the menu within the window.
  if (root.getBoundingClientRect().left < 4) root.classList.add('to-right');
  root.querySelector('button')?.focus();
}

export function menu_button(words, label, entries) {
  const button = element('button', { type: 'button', class: 'icon small no-print', 'aria-label': label, title: label,
                                     'aria-haspopup': 'menu', 'aria-expanded': 'false' }, words);
  button.addEventListener('click', (event) => {
    event.stopPropagation();
    open_menu(button, entries());
  });
  return button;
}

document.addEventListener('click', (event) => open && !open.root.contains(event.target) && close_menu());
