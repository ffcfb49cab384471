// Dialog for a formula: it offers the channels and shows errors while the formula is typed.
import { functions, parse_formula } from './formula.js';
import { button, element } from './page.js';
import { open_dialog } from './dialog.js';

function put_in(field, words) {
  field.setRangeText(words, field.selectionStart, field.selectionEnd, 'end');
  field.focus();
  field.dispatchEvent(new Event('input'));
}

function channel_picker(channels, field) {
  const picker = element('select', { 'aria-label': 'Channel to insert into the formula' }, element('option', { value: '' }, 'Insert a channel…'));
  for (const channel of channels.with_samples())
    picker.append(element('option', { value: channel.id }, `${channels.words(channel)}  (${channel.id})`));
  picker.addEventListener('change', () => {
    put_in(field, picker.value);
    picker.value = '';
  });
  return picker;
}

function function_buttons(field) {
  return Object.entries(functions).map(([name, { takes, does }]) =>
    button({ title: does }, () => put_in(field, name === 'mean' ? 'mean(, 0.1 s)' : takes > 1 ? `${name}(, )` : `${name}()`), name));
}

// Calls `does` with { formula, name }; it returns an error message, or '' if it accepts the formula.
export function open_formula_dialog(channels, units, does, { start = '', title = 'A formula of channels' } = {}) {
  const field = element('input', { type: 'text', class: 'formula', maxlength: 500, spellcheck: 'false', autocomplete: 'off',
                                   'aria-label': 'Formula', placeholder: '/joint/hip/angle - /desired/joint/hip/angle' });
  const name = element('input', { type: 'text', maxlength: 80, 'aria-label': 'Name of the line', placeholder: 'Name of the line (default: the formula)' });
  const hint = element('p', { class: 'quiet' }, '+ − * / ( ), numbers with units as in 2 deg, and:');
  const check = () => {
    try {
      const { unit } = parse_formula(field.value, channels.units);
      return { unit, wrong: '' };
    } catch (error) {
      return { wrong: error.message };
    }
  };
  field.value = start;
  const { wrong } = open_dialog(title, [field, channel_picker(channels, field), hint,
    element('div', { class: 'functions' }, ...function_buttons(field)), name], 'Draw', () =>
    check().wrong || does({ formula: field.value.trim(), name: name.value.trim() }));
  field.addEventListener('input', () => {
    const { unit, wrong: why } = check();
    wrong.textContent = field.value.trim() && why ? why : '';
    hint.textContent = why ? '+ − * / ( ), numbers with units as in 2 deg, and:' : `Its unit is ${units.of(unit).label || '1'}.`;
  });
  field.focus();
}
