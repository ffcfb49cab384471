// Units in which the page shows what the log holds in SI.

const si = {
  share: { label: '%', scale: 100 },
  Pa: { label: 'kPa abs', scale: 1e-3 },
  'Pa diff': { label: 'kPa', scale: 1e-3 },
  'Pa abs': { label: 'kPa abs', scale: 1e-3 },
  'Pa gauge': { label: 'kPa gauge', scale: 1e-3 },
  kg: { label: 'g', scale: 1e3 },
};

const thesis = {
  share: { label: '%', scale: 100 },
  m: { label: 'in', scale: 1 / 0.0254 },
  'm/s': { label: 'in/s', scale: 1 / 0.0254 },
  N: { label: 'lbf', scale: 1 / 4.4482216152605 },
  Pa: { label: 'psi gauge', scale: 1 / 6894.757293168361, gauge: true },
  'Pa diff': { label: 'psi', scale: 1 / 6894.757293168361 },
  'Pa abs': { label: 'psi abs', scale: 1 / 6894.757293168361 },
  'Pa gauge': { label: 'psi gauge', scale: 1 / 6894.757293168361 },
  rad: { label: 'deg', scale: 180 / Math.PI },
  'rad/s': { label: 'deg/s', scale: 180 / Math.PI },
  'N m': { label: 'lbf in', scale: 1 / 0.1129848290276167 },
  'N m/rad': { label: 'lbf in/rad', scale: 1 / 0.1129848290276167 },
  kg: { label: 'g', scale: 1e3 },
};

export class Units {
  constructor(atmosphere) {
    this.atmosphere = atmosphere;
    this.system = 'si';
  }

  of(unit) {
    const table = this.system === 'thesis' ? thesis : si;
    const found = table[unit] ?? { label: unit === '1' ? '' : unit, scale: 1 };
    return { ...found, offset: found.gauge ? -this.atmosphere : 0 };
  }

  convert(value, unit) {
    const u = this.of(unit);
    return (value + u.offset) * u.scale;
  }

  text(value, unit) {
    const label = this.of(unit).label;
    return `${number(this.convert(value, unit))}${label ? ' ' + label : ''}`;
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

// "trolley.mean_speed_m_per_s" -> its unit in SI, as in docs/analysis.md.
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
