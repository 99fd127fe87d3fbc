// Times by the clock of the plant, as time_axis.cpp draws them: the page holds what that clock
// shows, so that no browser has to know its zone. Milliseconds since 1970.

const DAY_MS = 86400000;
const MONTHS = "Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec".split(" ");

// Distances between tics that people count in.
const TIME_STEPS_MS = [
  10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 15000, 30000, 60000, 120000, 300000, 600000,
  900000, 1800000, 3600000, 7200000, 10800000, 21600000, 43200000, DAY_MS, 2 * DAY_MS, 7 * DAY_MS,
  14 * DAY_MS, 30 * DAY_MS, 60 * DAY_MS, 90 * DAY_MS, 180 * DAY_MS, 365 * DAY_MS,
];

function clockAt(clocks, time) {
  const begun = clocks.filter(function (clock) { return clock.begin_ms <= time; });
  return begun.length ? begun[begun.length - 1] : clocks[0];
}

function twoDigits(number) {
  return String(number).padStart(2, "0");
}

// What the clock shows, in the fields of a Date that know no zone.
function shownBy(clock, time) {
  return new Date(Math.round(time) + clock.offset_ms);
}

function dayText(shown) {
  return shown.getUTCFullYear() + "-" + twoDigits(shown.getUTCMonth() + 1) + "-" +
    twoDigits(shown.getUTCDate());
}

function minuteText(shown) {
  return twoDigits(shown.getUTCHours()) + ":" + twoDigits(shown.getUTCMinutes());
}

function secondText(shown, withFraction) {
  const text = minuteText(shown) + ":" + twoDigits(shown.getUTCSeconds());
  if (!withFraction) return text;
  return text + "." + String(shown.getUTCMilliseconds()).padStart(3, "0");
}

// "2026-03-01", "13:00:05" and "CET"; fractions where samples lie between the seconds.
function partsOfMoment(trend, time) {
  const clock = clockAt(trend.clocks, time);
  const shown = shownBy(clock, time);
  const fraction = trend.interval_ms % 1000 !== 0 || trend.start_ms % 1000 !== 0;
  return [dayText(shown), secondText(shown, fraction), clock.words];
}

function momentText(trend, time) {
  return partsOfMoment(trend, time).join(" ");
}

// "2026-03-01 13:00:05 to 13:05:00 CET": what both ends have in common once.
function spanText(trend, from, to) {
  const begin = partsOfMoment(trend, from);
  const end = partsOfMoment(trend, to);
  if (begin[2] === end[2]) begin.pop();
  if (begin[0] === end[0]) end.shift();
  return begin.join(" ") + " to " + end.join(" ");
}

function ticText(shown, step) {
  if (step < 1000) return secondText(shown, true).slice(3);
  if (step < 60000) return secondText(shown, false);
  const day = shown.getUTCDate() + " " + MONTHS[shown.getUTCMonth()];
  if (step >= 90 * DAY_MS) return MONTHS[shown.getUTCMonth()] + " " + shown.getUTCFullYear();
  if (step >= DAY_MS || shown.getTime() % DAY_MS === 0) return day;
  return minuteText(shown);
}

function timeStep(span, most) {
  const fitting = TIME_STEPS_MS.find(function (step) { return span / step <= most; });
  return fitting || Math.ceil(span / most / (365 * DAY_MS)) * 365 * DAY_MS;
}

// The clocks that are shown from one time to another, each with the part in which it is.
function shownClocks(clocks, from, to) {
  return clocks.map(function (clock, k) {
    const end = k + 1 < clocks.length ? clocks[k + 1].begin_ms : Infinity;
    return { clock: clock, from: Math.max(from, clock.begin_ms), end: end };
  }).filter(function (part) { return part.from <= to && part.from < part.end; });
}

// Tics that are round by the clock, at most `most` of them, of which half as many where they have
// to name the clock.
function timeTics(clocks, from, to, most) {
  const parts = shownClocks(clocks, from, to);
  const changes = parts.length > 1;
  let step = timeStep(to - from, most);
  if (changes && step < DAY_MS) step = timeStep(to - from, most / 2);
  const tics = [];
  for (const part of parts) {
    const offset = part.clock.offset_ms;
    let tic = Math.ceil((part.from + offset) / step) * step - offset;
    for (; tic <= to && tic < part.end; tic += step) {
      const text = ticText(shownBy(part.clock, tic), step);
      tics.push({ time: tic, text: changes && step < DAY_MS ? text + " " + part.clock.words : text });
    }
  }
  return tics;
}

// "time (CET), 2026-03-01 to 2026-03-02".
function timeLabel(clocks, from, to) {
  const words = new Set(shownClocks(clocks, from, to).map(function (part) {
    return part.clock.words;
  }));
  const first = dayText(shownBy(clockAt(clocks, from), from));
  const last = dayText(shownBy(clockAt(clocks, to), to));
  const days = first === last ? first : first + " to " + last;
  return "time (" + Array.from(words).join(", then ") + "), " + days;
}
