// Units in which the page shows what the log holds in SI.

import { recall, remember } from './memory.js';

// Without a table everything stays in SI.
const none = { start: 'si', sets: [{ name: 'si', title: 'SI', about: '', units: {} }] };

// The table that the library wrote into the page (sinew/report/page/content.h).
export function page_units() {
  const text = globalThis.document?.getElementById('units-data')?.textContent;
  return text ? JSON.parse(text) : none;
}

export class Units {
  // Gauges count from `atmosphere` [Pa]. What a reader chose before holds for every page that begins
  // in the same units; one that somebody made to begin in others does.
  constructor(atmosphere, table = page_units()) {
    Object.assign(this, { atmosphere, table });
    this.choose(table.start);
    this.choose(recall(`units of ${table.start}`));
  }

  // Shows everything in the units of that set; one that is not there changes nothing.
  choose(name) {
    this.set = this.table.sets.find((s) => s.name === name) ?? this.set ?? this.table.sets[0];
  }

  // The same, and from now on.
  keep(name) {
    this.choose(name);
    remember(`units of ${this.table.start}`, name);
  }

  get system() {
    return this.set.name;
  }

  // `value`: a single number that stands alone, which may have a larger unit than an axis.
  of(unit, value) {
    let found = this.set.units[unit] ?? { label: unit === '1' ? '' : unit, scale: 1 };
    if (found.large && Math.abs(value) * found.scale >= 1000) found = found.large;
    return { ...found, offset: found.gauge ? -this.atmosphere : found.offset ?? 0 };
  }

  convert(value, unit) {
    const u = this.of(unit);
    return (value + u.offset) * u.scale;
  }

  // A number and its unit, apart: what a row of a table shows.
  words(value, unit) {
    const u = this.of(unit, value);
    return { value: (value + u.offset) * u.scale, label: u.label };
  }

  text(value, unit) {
    const shown = this.words(value, unit);
    return `${number(shown.value)}${shown.label ? ' ' + shown.label : ''}`;
  }
}

// Four digits for people; a dash for what is no number.
export function number(value) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replaceAll('-', '−');
  const decimals = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3;
  return value.toFixed(decimals).replace(/^-(0\.?0*)$/, '$1').replace('-', '−');
}

// Where there is little room: whole numbers, and one decimal of what is as small as bars are.
export function short_number(value) {
  return value.toFixed(Math.abs(value) < 20 ? 1 : 0).replace(/^-(0\.?0*)$/, '$1').replace('-', '−');
}

// Of an axis: as many digits as a tick has.
export function tick_text(v) {
  const size = Math.abs(v);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return v.toExponential(1).replaceAll('-', '−');
  return String(+v.toPrecision(6)).replace('-', '−');
}

// A difference: "+1.2", "−1.2", "=" for none.
export const signed = (value) => (value === 0 ? '=' : value > 0 ? `+${number(value)}` : number(value));

// Of a difference between two values in that unit.
export const difference_unit = (unit) => (unit === 'Pa' ? 'Pa diff' : unit);

// "trolley.mean_speed_m_per_s" -> its unit in SI, as in docs/reference/analysis.md.
const endings = [
  ['_Nm_per_rad', 'N m/rad'], ['_rad_per_s', 'rad/s'], ['_m_per_s', 'm/s'],
  ['_kg_per_m', 'kg/m'], ['_s_per_m', 's/m'], ['_J_per_m', 'J/m'], ['_per_m', '1/m'],
  ['_rad', 'rad'], ['_Nm', 'N m'], ['_kg', 'kg'], ['_count', 'count'],
  ['_diff_Pa', 'Pa diff'], ['_Pa', 'Pa'],
  ['_N', 'N'], ['_J', 'J'], ['_m', 'm'], ['_s', 's'],
];
export function unit_of_key(key) {
  const found = endings.find(([ending]) => key.endsWith(ending));
  return found ? found[1] : '1';
}

// "joints.hip.min_angle_rad" -> "hip · min angle"
export function words_of_key(key) {
  const found = endings.find(([ending]) => key.endsWith(ending));
  const name = found ? key.slice(0, -found[0].length) : key;
  return name.replace(/^(joints|muscles)\./, '').split('.').join(' · ').replaceAll('_', ' ');
}
