// Which samples are shown: from one to another, parts of a sample included.

const FEWEST_SHOWN = 4;

function wholeView(trend) {
  return { from: 0, to: trend.samples - 1 };
}

function viewOf(trend, from, to) {
  const last = trend.samples - 1;
  const span = Math.min(Math.max(to - from, Math.min(FEWEST_SHOWN, last)), last);
  const wanted = from + (to - from - span) / 2;
  const begin = Math.min(Math.max(wanted, 0), last - span);
  return { from: begin, to: begin + span };
}

function isWhole(trend, view) {
  return view.to - view.from >= trend.samples - 1;
}

// `factor` below 1 shows less; the sample `at` stays where it is.
function zoomed(trend, view, factor, at) {
  const last = trend.samples - 1;
  const span = view.to - view.from;
  const wanted = Math.min(Math.max(span * factor, Math.min(FEWEST_SHOWN, last)), last);
  const from = at - (at - view.from) * wanted / span;
  return viewOf(trend, from, from + wanted);
}

function moved(trend, view, by) {
  const span = view.to - view.from;
  const from = Math.min(Math.max(view.from + by, 0), trend.samples - 1 - span);
  return { from: from, to: from + span };
}
