// Units of formulas: the dimensions of a unit of the log, and the unit of a result.

import { known_units } from './quantities.js';

const bases = ['m', 'kg', 's', 'rad', 'count', 'K', 'A'];
const volt = { kg: 1, m: 2, s: -3, A: -1 };
const dims = (powers) => bases.map((b) => (powers[b] ?? 0) + (powers.V ?? 0) * (volt[b] ?? 0));

export const none = dims({});

// Returns the size in SI and the dimensions of a unit; null if it is unknown. Angle and converter count are
// dimensions, as everywhere in Sinew.
export function unit_word(word) {
  if (word === 'share') return { scale: 1, dims: none };
  const found = Object.hasOwn(known_units, word) ? known_units[word] : null;
  return found && { scale: found[0], dims: dims(found[1]) };
}

export const times = (a, b, power = 1) => a.map((p, i) => p + power * b[i]);
export const same = (a, b) => a.every((p, i) => Math.abs(p - b[i]) < 1e-9);

// Returns the dimensions of an SI unit in the log's spelling, "N m/rad", "m/s^2", "Pa gauge"; null if
// the unit is unknown.
export function dims_of(unit) {
  const text = unit.replace(/ (abs|diff|gauge)$/, '');
  let out = none, power = 1;
  for (const part of text.match(/[^\s/]+|\//g) ?? []) {
    if (part === '/') {
      if (power < 0) return null;
      power = -1;
      continue;
    }
    const [, word, exponent] = part.match(/^([A-Za-z]+|1)(?:\^(\d))?$/) ?? [];
    const found = word === '1' ? { dims: none } : word && unit_word(word);
    if (!found) return null;
    out = times(out, found.dims, power * Number(exponent ?? 1));
  }
  return out;
}

// Names of units of results, in the log's spelling; the first match is used.
const named = ['1', 'm', 'm/s', 'm/s^2', 'N', 'Pa', 'N/m', 'N/s', 'Pa/s', 'kg', 'kg/s', 'rad', 'rad/s', 'rad/s^2', 'N m',
  'N m/rad', 'N m s/rad', 'count', 'count/s', 's', '1/s', 'm^2', 'm^3', 'W', 'V', 'K', 'A'].map((name) => [name, dims_of(name)]);

export function name_of(powers) {
  const found = named.find(([, of]) => same(of, powers));
  if (found) return found[0];
  // Units with kg m/s^2 are written with N.
  const newton = dims({ kg: 1, m: 1, s: -2 });
  const of_force = powers[1] === 1 && powers[2] <= -2;
  const rest = of_force ? times(powers, newton, -1) : powers;
  const part = (sign) => bases.flatMap((base, i) => {
    const p = sign * rest[i];
    return p > 1e-9 ? [p === 1 ? base : `${base}^${+p.toFixed(3)}`] : [];
  });
  const above = [...(of_force ? ['N'] : []), ...part(1)].join(' ') || '1', below = part(-1);
  return below.length ? `${above}/${below.length > 1 ? `(${below.join(' ')})` : below[0]}` : above;
}
