// Modal dialog with a few fields, closed by its buttons or Escape.
import { button, element } from './page.js';

// Opens a dialog with the elements `fields`. `does(dialog)` performs the action; it returns an error
// message, or '' on success.
export function open_dialog(title, fields, done_words, does) {
  const wrong = element('p', { class: 'wrong', role: 'alert' });
  const done = element('button', { type: 'submit', class: 'done' }, done_words);
  const cancel = button({}, () => sheet.close(), 'Cancel');
  const form = element('form', { method: 'dialog' }, element('h3', {}, title), ...fields, wrong,
    element('div', { class: 'buttons' }, cancel, done));
  const sheet = element('dialog', { class: 'sheet no-print', 'aria-label': title }, form);
  const host = document.querySelector('dialog.enlarged[open]') ?? document.body;
  sheet.addEventListener('close', () => sheet.remove());
  sheet.addEventListener('keydown', (event) => event.stopPropagation());
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    wrong.textContent = does(sheet);
    if (!wrong.textContent) sheet.close();
  });
  host.append(sheet);
  sheet.showModal();
  return { sheet, wrong };
}

// Shows a message at the bottom of the page for six seconds.
export function show_message(words) {
  document.querySelector('.toast')?.remove();
  const toast = element('div', { class: 'toast no-print', role: 'status' }, words);
  (document.querySelector('dialog.enlarged[open]') ?? document.body).append(toast);
  setTimeout(() => toast.remove(), 6000);
}
