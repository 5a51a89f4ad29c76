// Draws the moving picture of the first page: the triad with its tips, the body and its ghost in
// the computer, and the error over the turns.
"use strict";

const Picture = (() => {
  const { cross, dot, turned } = Drift;
  const { DEGREE, MOST, STRAIGHT } = Triad;
  const [AZIMUTH, ELEVATION] = [38 * DEGREE, 30 * DEGREE]; // of the eye
  const SIDE = [-Math.sin(AZIMUTH), Math.cos(AZIMUTH), 0];
  const LEVEL = [Math.cos(AZIMUTH), Math.sin(AZIMUTH), 0];
  const TOWARDS = turned(LEVEL, SIDE.map((x) => -x * ELEVATION));
  const UP = cross(TOWARDS, SIDE);
  const SIZE = 110; // of a unit vector
  const VIEW = [300, 286];
  const REACH = [1, 1, 1, 1.28]; // of the three gyros and the axis of the turn
  const NAMES = ["gyro 1", "gyro 2", "gyro 3", "axis of the turn"];
  const ORIGIN = [0, 0, 0];

  // A paper dart, its nose along the first axis.
  const [NOSE, LEFT, RIGHT] = [[1.05, 0, 0], [-0.85, 0.72, 0.12], [-0.85, -0.72, 0.12]];
  const [SPINE, KEEL] = [[-0.7, 0, 0], [-0.75, 0, -0.36]];
  const FACES = [[NOSE, SPINE, KEEL], [NOSE, LEFT, SPINE], [NOSE, SPINE, RIGHT]];

  const times = (a, factor) => a.map((x) => x * factor);
  const seen = (a) => [SIZE * dot(SIDE, a), -SIZE * dot(UP, a)].map((x) => x.toFixed(1));
  const path = (points) => `M${points.map(seen).join("L")}`;
  const middle = (face) => face.reduce((total, a) => total + dot(TOWARDS, a), 0);
  const draw = (element, d) => element.setAttribute("d", d);

  function make(parent, name, attributes = {}) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return parent.appendChild(made);
  }
  const lines = (parent, name, count = 1) =>
    Array.from({ length: count }, () => make(parent, "path", { class: name }));

  // A tip that hand and keys move, with room around it for a finger.
  function tip(parent, i) {
    const made = make(parent, "g", {
      class: i < 3 ? "handle gyro" : "handle spindle",
      role: "slider",
      tabindex: 0,
      "aria-label": NAMES[i],
      "aria-describedby": "hero-how",
      "aria-valuemin": 0,
      "aria-valuemax": i < 3 ? MOST / DEGREE : 180,
    });
    make(made, "circle", { r: 22, class: "grip" });
    make(made, "circle", { r: 9 });
    make(made, "text").textContent = i < 3 ? i + 1 : "turn";
    return made;
  }

  // The place on the unit sphere, on the side of the eye, that is seen at a place of the window.
  function placeAt(view, x, y, reach) {
    const box = view.getBoundingClientRect();
    const scale = VIEW[0] / box.width / SIZE / reach;
    const [right, above] = [x - box.left - box.width / 2, box.top + box.height / 2 - y];
    const shrink = Math.max(1 / scale, Math.hypot(right, above));
    const [a, b] = [right / shrink, above / shrink];
    const c = Math.sqrt(Math.max(0, 1 - a * a - b * b));
    return SIDE.map((_, k) => a * SIDE[k] + b * UP[k] + c * TOWARDS[k]);
  }

  // Fills the three drawings in an element; returns the tips and what draws them anew.
  function picture(hero, turns) {
    const [triad, flight, curve] = hero.querySelectorAll("svg");
    for (const view of [triad, flight]) {
      view.setAttribute("viewBox", [-VIEW[0] / 2, -VIEW[1] / 2, ...VIEW].join(" "));
    }
    curve.setAttribute("viewBox", `0 0 ${turns} 1`);
    make(triad, "circle", { class: "sphere", r: SIZE });
    lines(triad, "straight", 3).forEach((line, i) => draw(line, path([ORIGIN, STRAIGHT[i]])));
    const gyros = lines(triad, "gyro", 3);
    const [spindle] = lines(triad, "spindle");
    const tips = NAMES.map((_, i) => tip(triad, i));
    const [way, wayOfGhost] = [...lines(flight, "way"), ...lines(flight, "way of-ghost")];
    const [far] = lines(flight, "spindle");
    const [body, ghost] = [lines(flight, "body", 3), lines(flight, "ghost", 3)];
    const [near] = lines(flight, "spindle");
    const [whole, error, dots, now] = ["whole", "error", "dots", "now"].map(
      (name) => lines(curve, name)[0],
    );

    // The bend and the axis, and the error that follows from them; returns its greatest, in rad.
    function drawTriad(ends, axis, M) {
      ends.forEach((end, i) => draw(gyros[i], path([ORIGIN, end])));
      draw(spindle, path([times(axis, -1.1), times(axis, REACH[3])]));
      draw(far, path([times(axis, -1.2), ORIGIN]));
      draw(near, path([ORIGIN, times(axis, 1.2)]));
      [...ends, axis].forEach((end, i) => {
        tips[i].setAttribute("transform", `translate(${seen(times(end, REACH[i]))})`);
        const upright = Math.abs(dot(SIDE, end)) < 0.35; // then the name stands beside the line
        const [beside, beyond] = i < 3 ? [19, seen(times(end, 0.18))] : [32, [0, -20]];
        const [x, y] = upright ? [beside, 0] : beyond;
        tips[i].lastChild.setAttribute("x", x);
        tips[i].lastChild.setAttribute("y", y);
      });
      const errors = Array.from({ length: 60 * turns + 1 }, (_, k) =>
        Drift.error(M, axis, (2 * Math.PI * k) / 60));
      const top = Math.max(10 * DEGREE, ...errors);
      const points = errors.map((x, k) => `${k / 60} ${1 - x / top}`);
      const ofTurns = points.filter((_, k) => k % 60 === 0);
      draw(error, `M${points.join("L")}`);
      draw(whole, `M${ofTurns.join("L")}`);
      draw(dots, ofTurns.map((point) => `M${point}h0`).join(""));
      return Math.max(...errors);
    }

    // The body, its ghost, and the ways of their noses in the last turn.
    function drawMoment(moment, axis, M) {
      const turnOf = (angle) => times(axis, angle);
      const ghostOf = (angle) => Drift.believed(M, axis, angle);
      const placed = (rotation) => FACES.map((face) => face.map((a) => turned(a, rotation)));
      const end = 2 * Math.PI * moment;
      const begin = 2 * Math.PI * Math.max(moment - 1, 0);
      const angles = Array.from({ length: 61 }, (_, k) => begin + ((end - begin) * k) / 60);
      draw(way, path(angles.map((angle) => turned(NOSE, turnOf(angle)))));
      draw(wayOfGhost, path(angles.map((angle) => turned(NOSE, ghostOf(angle)))));
      const faces = placed(turnOf(end)).sort((a, b) => middle(a) - middle(b)); // nearest last
      faces.forEach((face, i) => draw(body[i], `${path(face)}Z`));
      placed(ghostOf(end)).forEach((face, i) => draw(ghost[i], `${path(face)}Z`));
      draw(now, `M${moment} 0V1`);
    }

    return { tips, drawTriad, drawMoment, placeAt: (i, x, y) => placeAt(triad, x, y, REACH[i]) };
  }

  return { SIDE, TOWARDS, UP, picture };
})();
