// Curves over the scene's time, whose present moment they share.

class PlotOfTime {
  constructor(parent, scene) {
    this.scene = scene;
    this.root = this.svg = make(parent, "svg", {
      viewBox: `0 0 ${PLOT.width} ${PLOT.height}`,
      class: "dl-plot",
      role: "img",
    });
    const scrub = (event) => {
      const box = this.svg.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * PLOT.width - PLOT.left;
      const part = x / (PLOT.width - PLOT.left - PLOT.right);
      scene.goTo(Math.round(part * (scene.stage.times.length - 1)));
    };
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      scrub(event);
      this.svg.onpointermove = scrub;
    });
    for (const end of ["pointerup", "pointercancel"]) {
      this.svg.addEventListener(end, () => (this.svg.onpointermove = null));
    }
  }

  update(plot) {
    const { times, timeTicks, timeUnit } = this.scene.stage;
    const [first, last] = [times[0], times.at(-1)];
    const [width, height] = [PLOT.width - PLOT.left - PLOT.right, PLOT.height - PLOT.top - PLOT.bottom];
    this.x = (time) => PLOT.left + (width * (time - first)) / (last - first);
    const y = (value) => PLOT.top + (height * (plot.high - value)) / (plot.high - plot.low);
    const bottom = PLOT.top + height;
    this.svg.replaceChildren();
    this.svg.setAttribute("aria-label", `${plot.title}: ${plot.curves.map((c) => c.name).join(", ")}`);
    make(this.svg, "text", { x: PLOT.left, y: 13, class: "dl-title" }, plot.title);
    for (const [tick, text] of plot.ticks) {
      const at = y(tick).toFixed(2);
      make(this.svg, "path", { d: `M${PLOT.left},${at}H${PLOT.left + width}`, class: "dl-rule" });
      const style = { x: PLOT.left - 5, y: at, class: "dl-tick dl-end" };
      make(this.svg, "text", style, text);
    }
    for (const tick of timeTicks) {
      const at = this.x(tick).toFixed(2);
      make(this.svg, "text", { x: at, y: bottom + 14, class: "dl-tick dl-middle" }, String(tick));
    }
    make(this.svg, "text", { x: PLOT.left + width + 8, y: bottom + 14, class: "dl-tick" }, timeUnit);
    // Every curve twice: faint as a whole, and in full up to the present moment.
    const id = `dl-${crypto.getRandomValues(new Uint32Array(2)).join("")}`;
    const clip = make(make(this.svg, "defs"), "clipPath", { id });
    this.past = make(clip, "rect", { x: PLOT.left - 4, y: 0, height: PLOT.height });
    const taken = [];
    for (const curve of plot.curves) {
      const d = curve.moments
        ? Array.from(curve.moments, (k) => `M${places([[this.x(times[k]), y(curve.values[k])]])}h0`).join("")
        : curvePath(times, curve.values, this.x, y);
      const style = `dl-curve dl-${curve.style}${curve.moments ? " dl-moments" : ""}`;
      make(this.svg, "path", { d, class: `${style} dl-future` });
      make(this.svg, "path", { d, class: style, "clip-path": `url(#${id})` });
      const end = [...curve.values].filter((value) => !Number.isNaN(value)).at(-1);
      if (end === undefined || !curve.name) continue;
      let at = Math.max(PLOT.top + 4, Math.min(bottom, y(end)));
      const away = at > PLOT.height / 2 ? -1 : 1; // towards the middle, where there is room
      while (taken.some((other) => Math.abs(other - at) < 11)) at += away;
      taken.push(at);
      const place = { x: PLOT.left + width + 8, y: at.toFixed(2), class: `dl-name dl-${curve.style}` };
      make(this.svg, "text", place, curve.name);
    }
    this.cursor = make(this.svg, "path", { class: "dl-cursor" });
    this.span = `V${bottom}`;
  }

  draw(k) {
    const x = this.x(this.scene.stage.times[k]);
    this.past.setAttribute("width", Math.max(0, x - PLOT.left + 4).toFixed(2));
    this.cursor.setAttribute("d", `M${x.toFixed(2)},${PLOT.top}${this.span}`);
  }
}

// A line with a gap wherever a value is missing.
const curvePath = (times, values, x, y) => {
  let path = "";
  values.forEach((value, k) => {
    if (Number.isNaN(value)) return;
    const begins = k === 0 || Number.isNaN(values[k - 1]);
    path += `${begins ? "M" : "L"}${places([[x(times[k]), y(value)]])}`;
  });
  return path;
};

