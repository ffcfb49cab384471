// Units of the page; the log is in SI.

import { recall, remember } from './memory.js';
import { key_endings } from './quantities.js';

// Used if the page has no table of units: everything stays in SI.
const none = { start: 'si', sets: [{ name: 'si', title: 'SI', about: '', units: {} }] };

// Returns the table that the library has written into the page (sinew/report/page/content.h).
export function page_units() {
  const text = globalThis.document?.getElementById('units-data')?.textContent;
  return text ? JSON.parse(text) : none;
}

export class Units {
  // Gauge pressures are relative to `atmosphere` [Pa]. A reader's earlier choice applies to every page with
  // the same initial units, but not to pages that were made with other initial units.
  constructor(atmosphere, table = page_units()) {
    Object.assign(this, { atmosphere, table });
    this.choose(table.start);
    this.choose(recall(`units of ${table.start}`));
  }

  // Selects a set of units; an unknown name has no effect.
  choose(name) {
    this.set = this.table.sets.find((s) => s.name === name) ?? this.set ?? this.table.sets[0];
  }

  // Selects a set of units and stores the choice.
  choose_and_store(name) {
    this.choose(name);
    remember(`units of ${this.table.start}`, name);
  }

  get system() {
    return this.set.name;
  }

  // Returns label, scale and offset of a unit. A single `value` of 1000 or more may get a larger unit, which
// an axis does not use.
  of(unit, value) {
    let found = this.set.units[unit] ?? { label: unit === '1' ? '' : unit, scale: 1 };
    if (found.large && Math.abs(value) * found.scale >= 1000) found = found.large;
    return { ...found, offset: found.gauge ? -this.atmosphere : found.offset ?? 0 };
  }

  convert(value, unit) {
    const u = this.of(unit);
    return (value + u.offset) * u.scale;
  }

  // Returns a number and its unit separately, for a row of a table.
  words(value, unit) {
    const u = this.of(unit, value);
    return { value: (value + u.offset) * u.scale, label: u.label };
  }

  text(value, unit) {
    const shown = this.words(value, unit);
    return `${number(shown.value)}${shown.label ? ' ' + shown.label : ''}`;
  }
}

// Returns a number with about four digits; a dash for NaN and infinity.
export function number(value) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replaceAll('-', '−');
  const decimals = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3;
  return value.toFixed(decimals).replace(/^-(0\.?0*)$/, '$1').replace('-', '−');
}

// Returns a short number, for narrow places: a whole number, or one decimal below 20, as for bar.
export function short_number(value) {
  return value.toFixed(Math.abs(value) < 20 ? 1 : 0).replace(/^-(0\.?0*)$/, '$1').replace('-', '−');
}

// Returns the number of a tick, with as many digits as it needs.
export function tick_text(v) {
  const size = Math.abs(v);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return v.toExponential(1).replaceAll('-', '−');
  return String(+v.toPrecision(6)).replace('-', '−');
}

// Returns a difference: "+1.2", "−1.2", or "=" for zero.
export const signed = (value) => (value === 0 ? '=' : value > 0 ? `+${number(value)}` : number(value));

// Returns the unit of a difference between two values in this unit.
export const difference_unit = (unit) => (unit === 'Pa' ? 'Pa diff' : unit);

// "trolley.mean_speed_m_per_s" -> its unit in SI, as in docs/reference/analysis.md.
const ending_of = (key) => key_endings.find(([ending]) => key.endsWith(ending));
export function unit_of_key(key) {
  const unit = ending_of(key)?.[1] ?? '1';
  return unit === 'Pa abs' ? 'Pa' : unit;
}

// "joints.hip.min_angle_rad" -> "hip · min angle"
export function words_of_key(key) {
  const found = ending_of(key);
  const name = found ? key.slice(0, -found[0].length) : key;
  return name.replace(/^(joints|muscles)\./, '').split('.').join(' · ').replaceAll('_', ' ');
}
