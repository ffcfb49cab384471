// Shapes of charts as SVG paths, which a canvas also accepts: marks of left-out points, and bands.

// Hollow marks around (x, y) of size `r`: cross, triangle, square, diamond.
const marks = [
  (x, y, r) => `M${x - r} ${y - r}L${x + r} ${y + r}M${x - r} ${y + r}L${x + r} ${y - r}`,
  (x, y, r) => `M${x} ${y - 1.2 * r}L${x + 1.15 * r} ${y + 0.85 * r}L${x - 1.15 * r} ${y + 0.85 * r}Z`,
  (x, y, r) => `M${x - r} ${y - r}H${x + r}V${y + r}H${x - r}Z`,
  (x, y, r) => `M${x} ${y - 1.3 * r}L${x + 1.3 * r} ${y}L${x} ${y + 1.3 * r}L${x - 1.3 * r} ${y}Z`,
];
export const mark_path = (mark, x, y, r) => marks[mark % marks.length](x, y, r);

// Returns the outline of a measured point: a disc, or the curve's mark. Held-out points are larger.
export function point_path(curve, x, y, r) {
  const size = curve.style === 'points' ? r : 1.25 * r;
  return curve.mark ? mark_path(curve.mark, x, y, 1.15 * size) : `M${x - size} ${y}a${size} ${size} 0 1 0 ${2 * size} 0a${size} ${size} 0 1 0 ${-2 * size} 0Z`;
}

// Returns the area between the curve's lower and upper line, in pixels: one part for each stretch where
// both are finite. All parts have the same direction, so that overlapping parts are filled once.
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

// Opacity of a band. The 68 % band is drawn over the 95 % band and is darker.
export const band_opacity = (label) => (label.startsWith('68') ? 0.3 : 0.17);

// Returns a sample of a curve for a legend, as SVG, 26 pixels wide.
export function sample_of(curve) {
  const svg = (inner) => `<svg viewBox="0 0 26 10" width="26" height="10" aria-hidden="true">${inner}</svg>`;
  if (curve.style === 'band') return svg(`<rect width="26" height="10" fill="var(--line)" fill-opacity="${band_opacity(curve.label) + 0.1}"/>`);
  if (curve.style === 'points') return svg(`<path d="${point_path(curve, 13, 5, 3.8)}" fill="var(--line)"/>`);
  if (curve.style === 'left out') return svg(`<path d="${mark_path(curve.mark ?? 0, 13, 5, 3.4)}" fill="none" stroke="var(--line)" stroke-width="1.4"/>`);
  return svg(`<path d="M0 5H26" fill="none" stroke="var(--line)" stroke-width="${curve.bold ? 3 : 2}" stroke-dasharray="${(curve.dash ?? []).join(' ')}"/>`);
}
