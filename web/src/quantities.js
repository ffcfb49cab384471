// Tables of the library, written by sinew/report/page/units_test.cpp.

// Units by name: size in SI and powers of the base units.
export const known_units = {
  '%': [0.01, {}], m: [1, { m: 1 }], km: [1000, { m: 1 }], cm: [0.01, { m: 1 }], mm: [0.001, { m: 1 }],
  in: [0.0254, { m: 1 }], ft: [0.3048, { m: 1 }], L: [0.001, { m: 3 }], mL: [1e-06, { m: 3 }],
  gal: [0.0037854117839999997, { m: 3 }], s: [1, { s: 1 }], ms: [0.001, { s: 1 }], us: [1e-06, { s: 1 }],
  min: [60, { s: 1 }], h: [3600, { s: 1 }], Hz: [1, { s: -1 }], kHz: [1000, { s: -1 }], kg: [1, { kg: 1 }],
  g: [0.001, { kg: 1 }], mg: [1e-06, { kg: 1 }], lb: [0.45359237, { kg: 1 }], slug: [14.593902937206362, { kg: 1 }],
  N: [1, { kg: 1, m: 1, s: -2 }], kN: [1000, { kg: 1, m: 1, s: -2 }], lbf: [4.4482216152605, { kg: 1, m: 1, s: -2 }],
  Pa: [1, { kg: 1, m: -1, s: -2 }], kPa: [1000, { kg: 1, m: -1, s: -2 }], MPa: [1000000, { kg: 1, m: -1, s: -2 }],
  bar: [100000, { kg: 1, m: -1, s: -2 }], psi: [6894.757293168361, { kg: 1, m: -1, s: -2 }], K: [1, { K: 1 }],
  degR: [0.5555555555555556, { K: 1 }], rad: [1, { rad: 1 }], deg: [0.017453292519943295, { rad: 1 }],
  rpm: [0.10471975511965977, { s: -1, rad: 1 }], count: [1, { count: 1 }], V: [1, { V: 1 }], mV: [0.001, { V: 1 }],
  A: [1, { A: 1 }], mA: [0.001, { A: 1 }], ohm: [1, { V: 1, A: -1 }], H: [1, { s: 1, V: 1, A: -1 }],
  mH: [0.001, { s: 1, V: 1, A: -1 }], J: [1, { kg: 1, m: 2, s: -2 }], W: [1, { kg: 1, m: 2, s: -3 }],
  mbar: [100, { kg: 1, m: -1, s: -2 }],
};

// Endings of keys and their units; the longest first.
export const key_endings = [
  ['_Nm_per_rad', 'N m/rad'], ['_N_s_per_m', 'N s/m'], ['_rad_per_s', 'rad/s'], ['_m_per_s', 'm/s'],
  ['_kg_per_m', 'kg/m'], ['_s_per_m', 's/m'], ['_J_per_m', 'J/m'], ['_per_m', '1/m'], ['_rad', 'rad'],
  ['_Nm', 'N m'], ['_kg', 'kg'], ['_count', 'count'], ['_diff_Pa', 'Pa diff'], ['_Pa', 'Pa abs'], ['_Hz', 'Hz'],
  ['_N', 'N'], ['_J', 'J'], ['_m', 'm'], ['_s', 's'],
];
