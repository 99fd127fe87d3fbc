// Draws what is shown on a canvas: a pane for set point and process variable, one for output and
// valve, below them their time axis. CSS pixels.

const FONT = "12px Arial, 'Liberation Sans', sans-serif";
const TEXT = "#333333";
const FRAME = "#888888";
const GRID = "#dddddd";
const TOP = 22;     // the key of the first pane
const BOTTOM = 42;  // tics and label of the time axis
const GAP = 26;     // the key of the next pane
const RIGHT = 12;
const TIC_ROOM = 80;
const DOTS_FROM_PX = 5;  // between samples that are drawn as dots

// The panes that hold a curve, from top to bottom, with the scale of what is shown in each.
function panesOf(trend, view, height) {
  const held = [0, 1].map(function (pane) {
    return trend.curves.filter(function (curve) { return curve.pane === pane; });
  }).filter(function (curves) { return curves.length > 0; });
  const each = (height - TOP - BOTTOM - GAP * (held.length - 1)) / held.length;
  return held.map(function (curves, k) {
    return {
      curves: curves,
      top: TOP + k * (each + GAP),
      height: each,
      scale: valueScale(curves, Math.floor(view.from), Math.ceil(view.to)),
    };
  });
}

// Where samples and values lie; `left` leaves room for the widest number of a value axis.
function layoutOf(context, trend, view, width, height) {
  context.font = FONT;
  const panes = panesOf(trend, view, height);
  let widest = 20;
  for (const pane of panes) {
    for (const tic of pane.scale ? pane.scale.tics : [])
      widest = Math.max(widest, context.measureText(tic.text).width);
  }
  const left = Math.ceil(widest) + 12;
  const plot = Math.max(width - left - RIGHT, 1);
  const perSample = plot / Math.max(view.to - view.from, 1e-9);
  return {
    panes: panes, left: left, plot: plot, right: left + plot, perSample: perSample,
    width: width, bottom: height - BOTTOM,
    x: function (sample) { return left + (sample - view.from) * perSample; },
    view: view,
    sampleAt: function (x) { return view.from + (x - left) / perSample; },
    y: function (pane, value) {
      const scale = pane.scale;
      return pane.top + pane.height * (scale.high - value) / (scale.high - scale.low);
    },
  };
}

function drawLine(context, x1, y1, x2, y2) {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}

function drawKey(context, layout, pane) {
  let x = layout.right;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const curve of pane.curves.slice().reverse()) {
    const y = pane.top - 11;
    context.fillStyle = TEXT;
    context.fillText(curve.name, x, y);
    x -= context.measureText(curve.name).width + 6;
    context.strokeStyle = curve.colour;
    context.lineWidth = 2;
    context.setLineDash(curve.dashed ? [5, 3] : []);
    drawLine(context, x - 22, y, x, y);
    context.setLineDash([]);
    x -= 36;
  }
  const names = pane.curves.map(function (curve) { return curve.name; }).join(", ");
  const unit = pane.curves[0].unit;
  context.fillStyle = TEXT;
  context.textAlign = "left";
  context.fillText(unit ? names + " (" + unit + ")" : names, layout.left, pane.top - 11,
    Math.max(x - layout.left, 40));
}

function drawPaneAxes(context, layout, pane, timeTics) {
  context.lineWidth = 1;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const tic of pane.scale ? pane.scale.tics : []) {
    const y = Math.round(layout.y(pane, tic.value)) + 0.5;
    context.strokeStyle = GRID;
    drawLine(context, layout.left, y, layout.right, y);
    context.fillStyle = TEXT;
    context.fillText(tic.text, layout.left - 6, y);
  }
  context.strokeStyle = GRID;
  for (const tic of timeTics) drawLine(context, tic.x, pane.top, tic.x, pane.top + pane.height);
  context.strokeStyle = FRAME;
  const foot = Math.round(pane.top + pane.height) + 0.5;
  drawLine(context, layout.left, foot, layout.right, foot);
  drawLine(context, layout.left + 0.5, pane.top, layout.left + 0.5, foot);
  drawKey(context, layout, pane);
  if (pane.scale) return;
  context.textAlign = "center";
  context.fillText("nothing recorded here", layout.left + layout.plot / 2, pane.top + pane.height / 2);
}

function placedTimeTics(trend, view, layout) {
  const from = timeOf(trend, view.from);
  const to = timeOf(trend, view.to);
  const most = Math.max(2, layout.plot / TIC_ROOM);
  return timeTics(trend.clocks, from, to, most).map(function (tic) {
    const x = layout.x((tic.time - trend.start_ms) / trend.interval_ms);
    return { x: Math.round(x) + 0.5, text: tic.text };
  });
}

function drawTimeAxis(context, trend, view, layout, tics) {
  context.textBaseline = "alphabetic";
  context.textAlign = "center";
  context.fillStyle = TEXT;
  for (const tic of tics) {
    const half = context.measureText(tic.text).width / 2;
    const x = Math.min(Math.max(tic.x, half), layout.width - half);
    context.fillText(tic.text, x, layout.bottom + 16);
  }
  const words = timeLabel(trend.clocks, timeOf(trend, view.from), timeOf(trend, view.to));
  context.fillText(words, layout.left + layout.plot / 2, layout.bottom + 34, layout.plot);
}

// Of samples that share a column of the screen the lowest and the highest, in their order, so that no
// spike and no swing is lost (figures/min_max_envelope.hpp); a gap is told by one null.
function thinned(values, from, to, perSample) {
  const points = [];
  for (let k = from; k <= to;) {
    const column = Math.floor(k * perSample);
    let low = -1;
    let high = -1;
    for (; k <= to && Math.floor(k * perSample) === column; ++k) {
      if (!Number.isFinite(values[k])) continue;
      if (low < 0 || values[k] < values[low]) low = k;
      if (high < 0 || values[k] > values[high]) high = k;
    }
    if (low < 0) points.push(null);
    else for (const at of new Set([Math.min(low, high), Math.max(low, high)])) points.push(at);
  }
  return points;
}

function tracePoints(context, layout, pane, curve, points) {
  let before = null;
  context.beginPath();
  for (const k of points) {
    if (k === null) {
      before = null;
      continue;
    }
    const x = layout.x(k);
    const y = layout.y(pane, curve.values[k]);
    if (before === null) {
      context.moveTo(x, y);
      context.lineTo(x + 0.01, y);  // one that stands alone is a dot
    } else {
      if (curve.held && layout.perSample >= 1) context.lineTo(x, before);
      context.lineTo(x, y);
    }
    before = y;
  }
  context.stroke();
}

function drawDots(context, trend, layout, pane, curve, points) {
  context.fillStyle = curve.colour;
  for (const k of points) {
    if (k === null || (curve.name === "pv" && !trend.isRow(k))) continue;
    context.beginPath();
    context.arc(layout.x(k), layout.y(pane, curve.values[k]), 2.2, 0, 2 * Math.PI);
    context.fill();
  }
}

function drawCurves(context, trend, view, layout, pane) {
  const from = Math.max(0, Math.floor(view.from) - 1);
  const to = Math.min(trend.samples - 1, Math.ceil(view.to) + 1);
  context.save();
  context.beginPath();
  context.rect(layout.left, pane.top - 3, layout.plot + 3, pane.height + 6);
  context.clip();
  for (const curve of pane.curves.slice().reverse()) {
    const points = thinned(curve.values, from, to, Math.min(layout.perSample, 1));
    context.strokeStyle = curve.colour;
    context.lineWidth = curve.dashed ? 1.6 : 1.3;
    context.lineJoin = "round";
    context.lineCap = curve.dashed ? "butt" : "round";
    context.setLineDash(curve.dashed ? [6, 4] : []);
    tracePoints(context, layout, pane, curve, points);
    context.setLineDash([]);
    if (layout.perSample >= DOTS_FROM_PX && !curve.dashed)
      drawDots(context, trend, layout, pane, curve, points);
  }
  context.restore();
}

function drawCursor(context, layout, cursor) {
  const x = layout.x(cursor);
  if (x < layout.left - 1 || x > layout.right + 1) return;
  context.strokeStyle = "#666666";
  context.lineWidth = 1;
  for (const pane of layout.panes) {
    drawLine(context, x, pane.top, x, pane.top + pane.height);
    for (const curve of pane.curves) {
      if (!pane.scale || !Number.isFinite(curve.values[cursor])) continue;
      context.fillStyle = curve.colour;
      context.beginPath();
      context.arc(x, layout.y(pane, curve.values[cursor]), 3.5, 0, 2 * Math.PI);
      context.fill();
    }
  }
}

function drawSelection(context, layout, selection) {
  const from = Math.max(layout.left, Math.min(selection[0], selection[1]));
  const to = Math.min(layout.right, Math.max(selection[0], selection[1]));
  context.fillStyle = "rgba(0, 114, 178, 0.15)";
  context.fillRect(from, TOP, to - from, layout.bottom - TOP);
}

// state: view, cursor (a sample or null), selection (two places or null).
function paint(canvas, trend, state) {
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  const scale = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  const context = canvas.getContext("2d");
  context.scale(scale, scale);
  const layout = layoutOf(context, trend, state.view, width, height);
  const tics = placedTimeTics(trend, state.view, layout);
  for (const pane of layout.panes) {
    drawPaneAxes(context, layout, pane, tics);
    if (pane.scale) drawCurves(context, trend, state.view, layout, pane);
  }
  drawTimeAxis(context, trend, state.view, layout, tics);
  if (state.selection) drawSelection(context, layout, state.selection);
  if (state.cursor !== null) drawCursor(context, layout, state.cursor);
  return layout;
}
