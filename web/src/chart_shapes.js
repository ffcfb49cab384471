// Shapes of charts, as SVG paths, which a canvas takes as well: marks of what was left out, and bands.

// A hollow mark about (x, y), `r` in size; each number has its own.
const marks = [
  (x, y, r) => `M${x - r} ${y - r}L${x + r} ${y + r}M${x - r} ${y + r}L${x + r} ${y - r}`,
  (x, y, r) => `M${x} ${y - 1.2 * r}L${x + 1.15 * r} ${y + 0.85 * r}L${x - 1.15 * r} ${y + 0.85 * r}Z`,
  (x, y, r) => `M${x - r} ${y - r}H${x + r}V${y + r}H${x - r}Z`,
  (x, y, r) => `M${x} ${y - 1.3 * r}L${x + 1.3 * r} ${y}L${x} ${y + 1.3 * r}L${x - 1.3 * r} ${y}Z`,
];
export const mark_path = (mark, x, y, r) => marks[mark % marks.length](x, y, r);

// The outline of a measured point, a disc but for a curve with a mark; larger of one held out.
export function point_path(curve, x, y, r) {
  const size = curve.style === 'points' ? r : 1.25 * r;
  return curve.mark ? mark_path(curve.mark, x, y, 1.15 * size) : `M${x - size} ${y}a${size} ${size} 0 1 0 ${2 * size} 0a${size} ${size} 0 1 0 ${-2 * size} 0Z`;
}

// The area between the curve's lower and upper line, in pixels: a part for each stretch where both
// are known, all in the same direction, so that parts that overlap are filled once.
export function band_path(curve, at_x, at_y) {
  let path = '', from = -1;
  const known = (i) => i < curve.x.length && Number.isFinite(curve.y[i]) && Number.isFinite(curve.y_high[i]);
  const point = (i, y) => `${at_x(curve.x[i]).toFixed(1)} ${at_y(y[i]).toFixed(1)}`;
  for (let i = 0; i <= curve.x.length; ++i) {
    if (known(i)) {
      if (from < 0) from = i;
      continue;
    }
    if (from >= 0 && i - from > 1) {
      const places = Array.from({ length: i - from }, (_, k) => from + k);
      path += `M${places.map((k) => point(k, curve.y)).join('L')}L${places.reverse().map((k) => point(k, curve.y_high)).join('L')}Z`;
    }
    from = -1;
  }
  return path;
}

// How dark a band is: that of 68 % lies within that of 95 %.
export const band_opacity = (label) => (label.startsWith('68') ? 0.3 : 0.17);

// Returns what a curve looks like, for a legend 26 pixels wide.
export function sample_of(curve) {
  const svg = (inner) => `<svg viewBox="0 0 26 10" width="26" height="10" aria-hidden="true">${inner}</svg>`;
  if (curve.style === 'band') return svg(`<rect width="26" height="10" fill="var(--line)" fill-opacity="${band_opacity(curve.label) + 0.1}"/>`);
  if (curve.style === 'points') return svg(`<path d="${point_path(curve, 13, 5, 3.8)}" fill="var(--line)"/>`);
  if (curve.style === 'left out') return svg(`<path d="${mark_path(curve.mark ?? 0, 13, 5, 3.4)}" fill="none" stroke="var(--line)" stroke-width="1.4"/>`);
  return svg(`<path d="M0 5H26" fill="none" stroke="var(--line)" stroke-width="${curve.bold ? 3 : 2}" stroke-dasharray="${(curve.dash ?? []).join(' ')}"/>`);
}
