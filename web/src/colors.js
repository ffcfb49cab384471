// Color scale for pressure, blue to yellow (after cividis). It is monotonic in lightness for every kind
// of color vision and in print.
const stops = [
  [0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120],
  [165, 156, 116], [195, 179, 105], [225, 204, 85], [254, 232, 56],
];

export function pressure_color(share) {
  const at = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at)), f = at - i;
  const c = stops[i].map((low, k) => Math.round(low + f * (stops[i + 1][k] - low)));
  return `rgb(${c.join(' ')})`;
}

export const pressure_gradient = `linear-gradient(90deg, ${stops.map((c) => `rgb(${c.join(' ')})`).join(', ')})`;
