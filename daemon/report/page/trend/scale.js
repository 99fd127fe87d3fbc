// The value axis of a pane: what is shown with a little air, at most six tics at multiples of 1, 2 or
// 5 times a power of ten.

function roundStep(span) {
  const rough = span / 6;
  const decade = Math.pow(10, Math.floor(Math.log10(rough)));
  for (const factor of [1, 2, 5]) {
    if (rough <= factor * decade) return factor * decade;
  }
  return 10 * decade;
}

function extremes(curves, from, to) {
  let low = Infinity;
  let high = -Infinity;
  for (const curve of curves) {
    for (let k = Math.max(0, from); k <= Math.min(to, curve.values.length - 1); ++k) {
      if (curve.values[k] < low) low = curve.values[k];
      if (curve.values[k] > high) high = curve.values[k];
    }
  }
  return low <= high ? [low, high] : null;
}

function ticNumber(value, step) {
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (decimals > 6 || Math.abs(value) >= 1e7) return String(Number(value.toPrecision(6)));
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? "0" : text;
}

// null = nothing of these curves is shown.
function valueScale(curves, from, to) {
  const found = extremes(curves, from, to);
  if (!found) return null;
  const span = found[1] - found[0];
  // A constant still has to be seen as a line within its axis.
  const air = span > 0 ? 0.06 * span : Math.max(Math.abs(found[1]) * 0.01, 1e-9);
  const low = found[0] - air;
  const high = found[1] + air;
  const step = roundStep(high - low);
  const tics = [];
  for (let n = Math.ceil(low / step); n * step <= high && tics.length < 20; ++n)
    tics.push({ value: n * step, text: ticNumber(n * step, step) });
  return { low: low, high: high, tics: tics };
}
