// Things in space, as the page shows them, and the hand that turns or drags them.

const radians = (angle) => (angle * Math.PI) / 180;
const degrees = (angle) => (angle * 180) / Math.PI;
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// Three unit vectors: to the right of the page, up the page, and out of it towards the reader.
const camera = (azimuth, elevation) => {
  const [a, e] = [radians(azimuth), radians(elevation)];
  return [
    [-Math.sin(a), Math.cos(a), 0],
    [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)],
    [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)],
  ];
};

// The vector v turned by the unit quaternion number k of a track, scalar last.
const turned = (track, k, v) => {
  const [x, y, z, w] = track.subarray(4 * k, 4 * k + 4);
  const c = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [
    v[0] + w * c[0] + y * c[2] - z * c[1],
    v[1] + w * c[1] + z * c[0] - x * c[2],
    v[2] + w * c[2] + x * c[1] - y * c[0],
  ];
};
const turnedBack = (track, k, v) => {
  const [x, y, z, w] = track.subarray(4 * k, 4 * k + 4);
  return turned(Float64Array.of(-x, -y, -z, w), 0, v);
};

// Corners of a part in space at moment k.
const placed = (part, tracks, k) => {
  const moving = part.shape.length === 3;
  const count = part.kind === "trace" ? k + 1 : part.shape.at(-2);
  const first = moving ? k * count * 3 : 0;
  const corners = [];
  for (let i = 0; i < count; i++) {
    const corner = part.points.slice(first + 3 * i, first + 3 * i + 3);
    corners.push(part.track ? turned(tracks[part.track], k, corner) : corner);
  }
  return corners;
};

const places = (points) => points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join("L");

// A shaft with two barbs; a shaft that points at the reader has none.
const arrowPath = ([a, b]) => {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy);
  const shaft = `M${places([a, b])}`;
  if (length < 1) return shaft;
  const size = Math.min(8, length / 2) / length;
  const barb = (side) => [
    b[0] - size * (dx + side * 0.4 * dy),
    b[1] - size * (dy - side * 0.4 * dx),
  ];
  return `${shaft}M${places([barb(1), b, barb(-1)])}`;
};

// Twice the area of a polygon; negative if its corners go counter-clockwise on the page, whose
// ordinate points down.
const area = (p) =>
  p.reduce((sum, [x, y], i) => {
    const [u, v] = p[(i + 1) % p.length];
    return sum + x * v - y * u;
  }, 0);

class ViewOfSpace {
  constructor(parent, scene) {
    this.scene = scene;
    this.root = make(parent, "figure", { class: "dl-view" });
    this.title = make(this.root, "figcaption");
    this.svg = make(this.root, "svg", {
      viewBox: `${-VIEW} ${-VIEW} ${2 * VIEW} ${2 * VIEW}`,
      tabindex: 0,
      role: "group",
    });
    make(this.svg, "title", {}, "drag to look around, or use the arrow keys");
    this.svg.addEventListener("pointerdown", (event) => this.pressed(event));
    this.svg.addEventListener("keydown", (event) => this.key(event));
    this.svg.addEventListener("dblclick", () => this.lookFrom(this.home));
  }

  update(view) {
    this.title.textContent = view.title;
    this.svg.setAttribute("aria-label", `${view.title}. Arrow keys look around.`);
    const same = this.view && JSON.stringify(this.view.parts.map(looks)) ===
      JSON.stringify(view.parts.map(looks));
    if (!same) this.build(view);
    this.view = view;
    view.parts.forEach((part, i) => (this.drawn[i].part = part));
    this.moved = true;
  }

  build(view) {
    this.home ??= [view.azimuth, view.elevation];
    this.eye ??= [...this.home];
    for (const each of this.drawn ?? []) each.element.remove();
    this.drawn = view.parts.map((part) => {
      const shape = { dot: "circle", label: "text" }[part.kind] ?? "path";
      const element = make(this.svg, shape, { class: `dl-${part.kind} dl-${part.style}` });
      if (part.fill) element.style.fill = part.fill;
      if (part.kind === "label") element.textContent = part.text;
      if (part.kind === "dot") element.setAttribute("r", part.handle ? 5 : 2.5);
      if (part.handle) {
        element.classList.add("dl-handle");
        for (const [name, value] of Object.entries({
          tabindex: 0,
          role: "button",
          "aria-label": `${part.handle}: drag it, or move it with the arrow keys`,
          "data-handle": part.handle,
        })) element.setAttribute(name, value);
        make(element, "title", {}, part.handle);
      }
      return { element, part };
    });
  }

  lookFrom([azimuth, elevation]) {
    this.eye = [azimuth, Math.max(-90, Math.min(90, elevation))];
    this.moved = true;
    this.scene.draw();
  }

  draw(k) {
    const { tracks } = this.scene.stage;
    const [right, up, out] = camera(...this.eye);
    const scale = VIEW / this.view.reach;
    for (const each of this.drawn) {
      const { part, element } = each;
      const there = k >= part.since;
      const still = !part.track && part.kind !== "trace" && part.shape.length < 3;
      if (still && !this.moved && there === each.there) continue;
      each.there = there;
      const corners = placed(part, tracks, k);
      const flat = corners.map((c) => [scale * dot(c, right), -scale * dot(c, up)]);
      each.depth = corners.reduce((sum, c) => sum + dot(c, out), 0) / corners.length + part.lift;
      const seen = there && (part.kind !== "face" || area(flat) < 0);
      element.setAttribute("visibility", seen ? "visible" : "hidden");
      const [x, y] = flat[0];
      if (part.kind === "dot") {
        element.setAttribute("cx", x.toFixed(2));
        element.setAttribute("cy", y.toFixed(2));
      } else if (part.kind === "label") {
        element.setAttribute("x", x.toFixed(2));
        element.setAttribute("y", y.toFixed(2));
      } else if (part.kind === "face") {
        element.setAttribute("d", `M${places(flat)}Z`);
      } else {
        element.setAttribute("d", part.kind === "arrow" ? arrowPath(flat) : `M${places(flat)}`);
      }
    }
    this.moved = false;
    // What is farther away is drawn first.
    const order = [...this.drawn].sort((a, b) => a.depth - b.depth);
    if (order.some((each, i) => each !== this.order?.[i])) {
      const focused = document.activeElement;
      let next = null;
      for (const { element } of [...order].reverse()) {
        if (element.nextSibling !== next) this.svg.insertBefore(element, next); // few have moved
        next = element;
      }
      if (this.svg.contains(focused)) focused.focus({ preventScroll: true });
      this.order = order;
    }
  }

  inView(event) {
    const box = this.svg.getBoundingClientRect();
    return [
      ((event.clientX - box.left) / box.width) * 2 * VIEW - VIEW,
      ((event.clientY - box.top) / box.height) * 2 * VIEW - VIEW,
    ];
  }

  pressed(event) {
    const handle = event.target.getAttribute?.("data-handle");
    let last = this.inView(event);
    this.svg.setPointerCapture(event.pointerId);
    (handle ? event.target : this.svg).focus({ preventScroll: true });
    event.preventDefault();
    const move = (moved) => {
      const here = this.inView(moved);
      if (handle) this.drag(handle, here);
      else {
        this.lookFrom([
          this.eye[0] - TURN * (here[0] - last[0]),
          this.eye[1] + TURN * (here[1] - last[1]),
        ]);
      }
      last = here;
    };
    const done = () => {
      this.svg.removeEventListener("pointermove", move);
      for (const end of ["pointerup", "pointercancel"]) this.svg.removeEventListener(end, done);
    };
    this.svg.addEventListener("pointermove", move);
    for (const end of ["pointerup", "pointercancel"]) this.svg.addEventListener(end, done);
  }

  // Where a handle is, or will be when the kernel has answered, as seen by the reader: to the right,
  // up, towards.
  seen(name) {
    const { part } = this.drawn.find((each) => each.part.handle === name);
    const { stage, moment, next, asking } = this.scene;
    const asked = next ?? asking;
    const points = asked?.handle === name ? asked.direction : part.points;
    const [place] = placed({ ...part, points, shape: [1, 3] }, stage.tracks, moment);
    return { part, place: camera(...this.eye).map((direction) => dot(direction, place)) };
  }

  // The handle stays on its sphere, on the side on which it is.
  drag(name, [x, y]) {
    const { part, place } = this.seen(name);
    const radius = Math.hypot(...place);
    let [right, up] = [(x * this.view.reach) / VIEW, (-y * this.view.reach) / VIEW];
    const out = Math.hypot(right, up);
    if (out > radius) [right, up] = [(right * radius) / out, (up * radius) / out];
    const depth = Math.sqrt(Math.max(0, radius ** 2 - right ** 2 - up ** 2));
    this.send(part, [right, up, place[2] < 0 ? -depth : depth]);
  }

  key(event) {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = arrows[event.key];
    if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const step = KEY_STEP * (event.shiftKey ? 0.25 : 1);
    const name = event.target.getAttribute?.("data-handle");
    if (!name) {
      this.lookFrom([this.eye[0] + 5 * step * way[0] / 2, this.eye[1] + 5 * step * way[1] / 2]);
      return;
    }
    // As on a globe whose axis stands up the page: each key moves the handle, wherever it is.
    const { part, place } = this.seen(name);
    const radius = Math.hypot(...place);
    const latitude = degrees(Math.asin(place[1] / radius)) + step * way[1];
    const north = radians(Math.max(-HIGHEST, Math.min(HIGHEST, latitude)));
    const east = Math.atan2(place[0], place[2]) + radians(step * way[0]);
    const next = [Math.cos(north) * Math.sin(east), Math.sin(north), Math.cos(north) * Math.cos(east)]
      .map((each) => radius * each);
    this.send(part, next, { key: true });
  }

  send(part, seen, more = {}) {
    const [right, up, out] = camera(...this.eye);
    let there = [0, 1, 2].map((i) => seen[0] * right[i] + seen[1] * up[i] + seen[2] * out[i]);
    const { stage, moment } = this.scene;
    if (part.track) there = turnedBack(stage.tracks[part.track], moment, there);
    this.scene.ask({ handle: part.handle, direction: there, ...more });
  }
}

// What a part looks like, wherever it is.
const looks = ({ kind, style, text, fill, handle, shape }) =>
  [kind, style, text, fill, handle, kind === "trace" ? 0 : shape];

