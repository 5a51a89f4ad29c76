// A living scene draws a stage (see stage.py) and lets it move: the arrays come from the kernel once,
// and playing, scrubbing and looking around need it no more. Only a dragged handle asks it for new
// ones. These pieces are one script: arrays, space, curves, scene.

const SVG = "http://www.w3.org/2000/svg";
const VIEW = 100; // half the width of a view in its own units: its reach
const PLOT = { width: 400, height: 140, left: 40, right: 100, top: 22, bottom: 22 };
const TURN = 0.5; // degrees that the eye goes round for one unit of the pointer
const KEY_STEP = 2; // degrees for one arrow key; with Shift a quarter of it
const HIGHEST = 89; // degrees towards the top or foot of a view; keys bring a handle no further

const make = (parent, tag, attributes = {}, text = "") => {
  const inSvg = parent.namespaceURI === SVG || tag === "svg";
  const element = inSvg ? document.createElementNS(SVG, tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text) element.textContent = text;
  parent.append(element);
  return element;
};

const numbers = (view) => {
  const start = view.byteOffset;
  return new Float64Array(view.buffer.slice(start, start + view.byteLength));
};

const unpack = (message) => ({
  ...message,
  times: numbers(message.times),
  tracks: Object.fromEntries(Object.entries(message.tracks).map(([n, t]) => [n, numbers(t)])),
  views: message.views.map((view) => ({
    ...view,
    parts: view.parts.map((part) => ({ ...part, points: numbers(part.points) })),
  })),
  plots: message.plots.map((plot) => ({
    ...plot,
    curves: plot.curves.map((curve) => ({
      ...curve,
      values: numbers(curve.values),
      moments: curve.moments && numbers(curve.moments),
    })),
  })),
  readouts: message.readouts.map((each) => ({ ...each, values: numbers(each.values) })),
});
