// The window as the page holds it: numbers in an attribute, texts as texts. Series are runs of equal
// values or base64 of single precision (live/sample_text.hpp); NaN = missing.

const DISPLAYED_DIGITS = 7;  // of single precision

function bytesOf(base64) {
  return Uint8Array.from(atob(base64), function (letter) { return letter.charCodeAt(0); });
}

function inDigits(value) {
  return Number(value.toPrecision(DISPLAYED_DIGITS));
}

function seriesOf(coded, samples) {
  const values = new Float64Array(samples).fill(NaN);
  if (typeof coded === "string") {
    const singles = new DataView(bytesOf(coded).buffer);
    for (let k = 0; k < samples; ++k) values[k] = inDigits(singles.getFloat32(4 * k, true));
    return values;
  }
  let from = 0;
  for (let k = 0; k < coded.length; k += 2) {
    if (coded[k + 1] !== null) values.fill(inDigits(coded[k + 1]), from, from + coded[k]);
    from += coded[k];
  }
  return values;
}

// Whether pv of a sample is a row of the historian; without such bits every one is.
function rowTest(coded) {
  if (coded === undefined) return function () { return true; };
  const bytes = bytesOf(coded);
  return function (k) { return (bytes[k >> 3] >> (k & 7) & 1) === 1; };
}

function inPercent(values, range) {
  const span = range[1] - range[0];
  return values.map(function (value) { return inDigits(100 * (value - range[0]) / span); });
}

// A curve: what is drawn, and what the historian holds where that is another number. Set point and
// output are held between two samples, measured values go on in between.
function curve(name, coded, samples, look, range) {
  const recorded = seriesOf(coded, samples);
  const scaled = range && (range[0] !== 0 || range[1] !== 100);
  return Object.assign({
    name: name,
    values: scaled ? inPercent(recorded, range) : recorded,
    recorded: scaled ? recorded : null,
  }, look);
}

// The colours of the pictures (figures/gnuplot_text.hpp): Okabe and Ito's.
const LOOKS = {
  sp: { colour: "#000000", dashed: true, held: true, pane: 0 },
  pv: { colour: "#0072b2", dashed: false, held: false, pane: 0 },
  op: { colour: "#d55e00", dashed: false, held: true, pane: 1 },
  mv: { colour: "#009e73", dashed: false, held: false, pane: 1 },
};

function clocksOf(figure) {
  return Array.from(figure.querySelectorAll("data"), function (clock) {
    const numbers = clock.value.split(" ").map(Number);
    return { begin_ms: numbers[0] / 1000, offset_ms: numbers[1] / 1000, words: clock.textContent };
  });
}

function windowOf(figure) {
  const held = JSON.parse(figure.dataset.window);
  const units = [figure.dataset.pvUnit, figure.dataset.opUnit];
  const curves = [];
  for (const name of ["sp", "pv", "op", "mv"]) {
    if (held[name] === undefined) continue;
    const look = LOOKS[name];
    const made = curve(name, held[name], held.samples, look, look.pane ? held.op_range : null);
    made.unit = units[look.pane];
    if (made.values.some(Number.isFinite)) curves.push(made);
  }
  return {
    samples: held.samples,
    start_ms: held.start_us / 1000,
    interval_ms: held.interval_s * 1000,
    stretch: held.stretch,
    curves: curves,
    clocks: clocksOf(figure),
    isRow: rowTest(held.pv_rows),
  };
}

function timeOf(trend, sample) {
  return trend.start_ms + trend.interval_ms * sample;
}
