// What people do with a trend: pointer, wheel, fingers and keys. `shown` is what trend.js makes: it
// holds the state and paints after each change.

const LEAST_DRAG_PX = 5;

function placeOf(canvas, event) {
  return event.clientX - canvas.getBoundingClientRect().left;
}

// A drag of the mouse: over a stretch that is to be shown, or of the picture with Shift. A finger
// drags the picture, or reads along it where all of it is shown.
function beginDrag(shown, event, x) {
  const touches = event.pointerType === "touch";
  if (touches && isWhole(shown.trend, shown.state.view)) return { reads: true };
  if (touches || event.shiftKey) return { grabbed: shown.layout.sampleAt(x) };
  return { from: x };
}

function goOn(shown, drag, x) {
  if (drag.grabbed !== undefined) {
    // From what is painted: the newest view may be a move further already.
    shown.show(moved(shown.trend, shown.layout.view, drag.grabbed - shown.layout.sampleAt(x)));
  } else if (drag.from !== undefined) {
    shown.select(Math.abs(x - drag.from) < LEAST_DRAG_PX ? null : [drag.from, x]);
  }
}

function endDrag(shown) {
  const selection = shown.state.selection;
  shown.select(null);
  if (!selection) return;
  const ends = selection.map(shown.layout.sampleAt);
  shown.show(viewOf(shown.trend, Math.max(0, Math.min(...ends)),
    Math.min(shown.trend.samples - 1, Math.max(...ends))));
}

// Two fingers: the samples that they took hold of stay below them.
function beginPinch(shown, fingers) {
  return Array.from(fingers.values(), shown.layout.sampleAt);
}

function pinch(shown, samples, fingers) {
  const places = Array.from(fingers.values());
  const apart = places[1] - places[0];
  if (Math.abs(apart) < 10 || samples[1] === samples[0]) return;
  const perSample = Math.max(apart / (samples[1] - samples[0]), 1e-6);
  const from = samples[0] - (places[0] - shown.layout.left) / perSample;
  shown.show(viewOf(shown.trend, from, from + shown.layout.plot / perSample));
}

function listenToPointers(canvas, shown) {
  const down = new Map();  // pointers and where they are
  let drag = null;
  let held = null;  // by two fingers

  canvas.addEventListener("pointerdown", function (event) {
    if (event.button !== 0) return;
    const x = placeOf(canvas, event);
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, x);
    held = down.size === 2 ? beginPinch(shown, down) : null;
    drag = down.size === 1 ? beginDrag(shown, event, x) : null;
    if (down.size === 1) shown.point(x);
  });
  canvas.addEventListener("pointermove", function (event) {
    const x = placeOf(canvas, event);
    if (down.has(event.pointerId)) down.set(event.pointerId, x);
    if (held) return pinch(shown, held, down);
    if (drag) goOn(shown, drag, x);
    if (!drag || drag.grabbed === undefined) shown.point(x);
  });
  function release(event) {
    if (!down.delete(event.pointerId)) return;
    if (drag && event.type === "pointerup") endDrag(shown);
    if (drag) shown.select(null);
    held = null;
    drag = null;
  }
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("dblclick", function () { shown.show(wholeView(shown.trend)); });
}

// The wheel scrolls the page, as people expect it of a page, until the trend was clicked or while
// Ctrl is held, which is also how browsers tell of a touchpad's pinch.
function listenToWheel(canvas, shown) {
  canvas.addEventListener("wheel", function (event) {
    if (!event.ctrlKey && document.activeElement !== canvas) return;
    const unit = event.deltaMode === 0 ? 1 : 16;
    const view = shown.state.view;
    const across = event.shiftKey ? event.deltaY || event.deltaX : event.deltaX;
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      if (isWhole(shown.trend, view)) return;
      event.preventDefault();
      return shown.show(moved(shown.trend, view, across * unit / shown.layout.perSample));
    }
    if (!event.ctrlKey && event.deltaY > 0 && isWhole(shown.trend, view)) return;
    event.preventDefault();
    const factor = Math.exp(Math.min(Math.max(event.deltaY * unit, -300), 300) * 0.002);
    shown.show(zoomed(shown.trend, view, factor, shown.layout.sampleAt(placeOf(canvas, event))));
  }, { passive: false });
}

// Zooming by a key or a button keeps the sample that is read in its place, else the middle.
function zoomBy(shown, factor) {
  const view = shown.state.view;
  const cursor = shown.state.cursor;
  const read = cursor !== null && cursor >= view.from && cursor <= view.to;
  shown.show(zoomed(shown.trend, view, factor, read ? cursor : (view.from + view.to) / 2));
}

function panBy(shown, share) {
  const view = shown.state.view;
  shown.show(moved(shown.trend, view, share * (view.to - view.from)));
}

const KEYS = {
  "+": function (shown) { zoomBy(shown, 0.5); },
  "=": function (shown) { zoomBy(shown, 0.5); },
  "-": function (shown) { zoomBy(shown, 2); },
  "_": function (shown) { zoomBy(shown, 2); },
  "0": function (shown) { shown.show(wholeView(shown.trend)); },
  Home: function (shown) { shown.show(wholeView(shown.trend)); },
  ArrowLeft: function (shown, shift) { return shift ? shown.step(-1) : panBy(shown, -0.2); },
  ArrowRight: function (shown, shift) { return shift ? shown.step(1) : panBy(shown, 0.2); },
};

function listenToKeys(canvas, shown) {
  canvas.addEventListener("keydown", function (event) {
    if (event.ctrlKey || event.altKey || event.metaKey || !Object.hasOwn(KEYS, event.key)) return;
    event.preventDefault();
    KEYS[event.key](shown, event.shiftKey);
  });
}
