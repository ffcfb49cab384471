// Menu of a button. Arrow keys move through it; Escape and a click elsewhere close it.
import { button, element } from './page.js';

let open = null;

export function close_menu(back = false) {
  if (!open) return;
  const { root, from } = open;
  open = null;
  root.remove();
  from.setAttribute('aria-expanded', 'false');
  if (back) from.focus();
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
export function open_menu(from, entries) {
  const again = open?.from === from;
  close_menu();
  if (again) return;
  const items = entries.filter(Boolean).map((entry) => {
    if (typeof entry === 'string') return element('p', { class: 'quiet' }, entry);
    return button({ role: 'menuitem' }, (event) => {
      event.stopPropagation();
      close_menu(true);
      entry[1]();
    }, entry[0]);
  });
  const root = element('div', { class: 'menu no-print', role: 'menu' }, ...items);
  root.addEventListener('keydown', key);
  from.setAttribute('aria-expanded', 'true');
  from.after(root);
  open = { root, from };
  // Keeps the menu within the window.
  if (root.getBoundingClientRect().left < 4) root.classList.add('to-right');
  root.querySelector('button')?.focus();
}

export function menu_button(words, label, entries) {
  return button({ class: 'icon small no-print', 'aria-label': label, title: label, 'aria-haspopup': 'menu', 'aria-expanded': 'false' }, (event, own) => {
    event.stopPropagation();
    open_menu(own, entries());
  }, words);
}

document.addEventListener('click', (event) => open && !open.root.contains(event.target) && close_menu());
