// The trend of a loop's window, which can be zoomed and panned; without a script the page shows the
// picture of the whole window in its place.

const HELP = "Drag over a stretch to see it closer, with Shift to move along; click and turn the " +
  "wheel to zoom. Keys: arrows move, + and \u2212 zoom, 0 shows the whole window, Shift and arrows " +
  "read sample by sample.";
const HELP_FOR_FINGERS = "Two fingers zoom, one moves; tap to read values.";

function element(name, className, text) {
  const made = document.createElement(name);
  made.className = className;
  made.textContent = text || "";
  return made;
}

function valueText(trend, curve, sample) {
  const value = curve.values[sample];
  if (!Number.isFinite(value)) return curve.name + " missing";
  let text = curve.name + " " + value + (curve.unit ? " " + curve.unit : "");
  if (curve.recorded) text += " (recorded " + curve.recorded[sample] + ")";
  if (curve.name === "pv" && !trend.isRow(sample)) text += " (between stored values)";
  return text;
}

function readingText(trend, sample) {
  if (sample === null) return "Point at the trend to read its values.";
  const values = trend.curves.map(function (curve) { return valueText(trend, curve, sample); });
  return momentText(trend, timeOf(trend, sample)) + ": " + values.join(", ");
}

function rangeText(trend, view) {
  const from = Math.ceil(view.from);
  const to = Math.floor(view.to);
  return spanText(trend, timeOf(trend, from), timeOf(trend, to)) + ": " + (to - from + 1) + " of " +
    trend.samples + " samples";
}

function makeCanvas(trend, describedBy) {
  const canvas = element("canvas", "");
  const names = trend.curves.map(function (curve) { return curve.name; }).join(", ");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-roledescription", "trend that can be zoomed");
  canvas.setAttribute("aria-label", "Trend of " + names + " over time");
  canvas.setAttribute("aria-describedby", describedBy.id);
  return canvas;
}

// What is shown, and what changes it: each change is painted with the next frame.
function makeShown(canvas, trend, reading, range) {
  const shown = {
    trend: trend,
    layout: null,
    state: { view: wholeView(trend), cursor: null, selection: null },
    show: function (view) { shown.state.view = view; changed(); },
    select: function (selection) { shown.state.selection = selection; changed(); },
    read: function (sample) {
      shown.state.cursor = Math.min(Math.max(Math.round(sample), 0), trend.samples - 1);
      changed();
    },
    point: function (x) {
      const view = shown.state.view;
      shown.read(Math.min(Math.max(shown.layout.sampleAt(x), Math.ceil(view.from)),
        Math.floor(view.to)));
    },
    step: function (by) {
      const view = shown.state.view;
      const cursor = shown.state.cursor;
      shown.read(cursor === null ? (view.from + view.to) / 2 : cursor + by);
      const at = shown.state.cursor;
      if (at < view.from) shown.show(moved(trend, view, at - view.from));
      if (at > view.to) shown.show(moved(trend, view, at - view.to));
    },
  };
  let waiting = false;
  function changed() {
    reading.textContent = readingText(trend, shown.state.cursor);
    range.textContent = rangeText(trend, shown.state.view);
    if (waiting) return;
    waiting = true;
    window.requestAnimationFrame(function () {
      waiting = false;
      shown.layout = paint(canvas, trend, shown.state);
    });
  }
  shown.layout = paint(canvas, trend, shown.state);
  new ResizeObserver(changed).observe(canvas);
  return shown;
}

function makeTools(shown) {
  const bar = element("div", "trend-tools");
  function button(text, words, act) {
    const made = element("button", "", text);
    made.type = "button";
    made.title = words;
    if (text !== words) made.setAttribute("aria-label", words);
    made.addEventListener("click", act);
    bar.append(made);
  }
  const trend = shown.trend;
  button("\u2190", "Earlier", function () { panBy(shown, -0.5); });
  button("\u2192", "Later", function () { panBy(shown, 0.5); });
  button("+", "Zoom in", function () { zoomBy(shown, 0.5); });
  button("\u2212", "Zoom out", function () { zoomBy(shown, 2); });
  button("Whole window", "Whole window", function () { shown.show(wholeView(trend)); });
  if (trend.stretch[1] > 1 && trend.stretch[1] < trend.samples) {
    button("A few cycles", "A few cycles", function () {
      shown.show(viewOf(trend, trend.stretch[0], trend.stretch[0] + trend.stretch[1] - 1));
    });
  }
  return bar;
}

function makeTrend(figure) {
  const trend = windowOf(figure);
  if (trend.samples < 2 || trend.curves.length === 0) return;
  const range = element("output", "trend-range");
  const reading = element("output", "trend-reading");
  const help = element("p", "note",
    window.matchMedia("(pointer: coarse)").matches ? HELP_FOR_FINGERS : HELP);
  help.id = "trend-help";
  const canvas = makeCanvas(trend, help);
  figure.append(range, canvas, reading, help);
  figure.hidden = false;
  figure.parentElement.classList.add("with-trend");
  const shown = makeShown(canvas, trend, reading, range);
  canvas.before(makeTools(shown));
  listenToPointers(canvas, shown);
  listenToWheel(canvas, shown);
  listenToKeys(canvas, shown);
}

for (const figure of document.querySelectorAll("figure.trend")) makeTrend(figure);
