// A sheet that asks for a few words: above the page until it is done or closed (Escape).
import { element } from './page.js';

// `fields`: elements; `does` gets the sheet and returns why it cannot be done, '' when it is.
export function open_sheet(title, fields, done_words, does) {
  const wrong = element('p', { class: 'wrong', role: 'alert' });
  const done = element('button', { type: 'submit', class: 'done' }, done_words);
  const cancel = element('button', { type: 'button' }, 'Cancel');
  const form = element('form', { method: 'dialog' }, element('h3', {}, title), ...fields, wrong,
    element('div', { class: 'buttons' }, cancel, done));
  const sheet = element('dialog', { class: 'sheet no-print', 'aria-label': title }, form);
  const host = document.querySelector('dialog.enlarged[open]') ?? document.body;
  cancel.addEventListener('click', () => sheet.close());
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

// Words for a moment at the foot of the page.
export function tell(words) {
  document.querySelector('.toast')?.remove();
  const toast = element('div', { class: 'toast no-print', role: 'status' }, words);
  (document.querySelector('dialog.enlarged[open]') ?? document.body).append(toast);
  setTimeout(() => toast.remove(), 6000);
}
