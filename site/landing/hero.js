// The moving picture of the first page: a triad that one bends, and a body that turns with it.
// This keeps what the reader set, lets time pass, listens to hand and keys, and says the numbers.
"use strict";

(() => {
  const { dot, error, perTurn, turned, unit } = Drift;
  const { DEGREE, STRAIGHT, bentTo, errors, lean, leaning } = Triad;
  const { SIDE, TOWARDS, UP, picture } = Picture;
  const TURNS = 5;
  const SECONDS = 4; // of a turn
  const REST = 1; // after it
  const TIMES = 100; // so much more is the triad bent in the picture

  const hero = document.getElementById("hero");
  hero.innerHTML = `
    <div class="hero-views">
      <figure class="hero-triad"><figcaption id="hero-how"><b>Bend a gyro, or turn the axis.</b>
        Drag a tip; or go to it with Tab and press arrow keys.</figcaption>
        <svg role="group" aria-label="three gyros and the axis of the turn"></svg></figure>
      <div class="hero-buttons">
        <button type="button" data-do="play"></button>
        <button type="button" data-do="worst">The worst axis</button>
        <button type="button" data-do="without">An axis without drift</button>
        <button type="button" data-do="begin">Start again</button>
      </div>
      <p class="hero-says"></p>
      <figure class="hero-flight"><figcaption><b>A body turns.</b> Dashed: where its computer, which
        believes the gyros, takes it to be.</figcaption>
        <svg role="img" aria-label="a paper dart that turns, and its ghost"></svg></figure>
    </div>
    <p class="hero-scale"><span>angle between the two attitudes, turn by turn</span>
      <span></span></p>
    <svg class="hero-curve" preserveAspectRatio="none" aria-hidden="true"></svg>
    <input type="range" min="0" max="${TURNS}" step="0.02" aria-label="turns made">
    <dl>
      <div><dt>drift as drawn, in degrees</dt><dd></dd></div>
      <div><dt>${TIMES} times less, in minutes</dt><dd></dd></div>
      <div><dt><label>this at <select><option value="1">1 turn<option value="10">10 turns<option
        value="60">60 turns</select> a minute</label></dt><dd></dd></div>
    </dl>
    <p class="hero-note"></p>
    <p class="hero-aloud" role="status"></p>`;
  const find = (selector) => hero.querySelector(selector);
  const [play, slider, rate] = ["[data-do=play]", "input", "select"].map(find);
  const [drawn, real, hourly] = hero.querySelectorAll("dd");
  const { tips, drawTriad, drawMoment, placeAt } = picture(hero, TURNS);

  let ends; // of the three gyros
  let axis; // of the turn
  let moment; // in turns
  let rest; // seconds still to wait at a whole turn
  let playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  let visible = true;

  function begin() {
    ends = [leaning(STRAIGHT[0], STRAIGHT[1], 8 * DEGREE), STRAIGHT[1], STRAIGHT[2]];
    axis = unit([1, 1, 0]);
    moment = 0;
    rest = REST;
  }

  // ---- words -----------------------------------------------------------------------------------
  const number = (x, of) =>
    `${x.toFixed(1).replace(/^-(?=0\.0$)/, "").replace("-", "−")}${of}`;
  const degrees = (x) => number(x / DEGREE, "°");
  const arcMinutes = (x) => number((60 * x) / DEGREE, "′");

  function leanInWords(i) {
    if (lean(ends, i) < 0.05 * DEGREE) return "straight";
    const [j, k] = [0, 1, 2].filter((other) => other !== i);
    const most = Math.abs(ends[i][j]) < Math.abs(ends[i][k]) ? k : j;
    const side = ends[i][most] > 0 ? "towards" : "away from";
    return `leans ${degrees(lean(ends, i))}, most ${side} axis ${most + 1}`;
  }

  function soFar(turns) {
    if (turns === 0) return "After one turn the body will be back. And in its computer?";
    const M = errors(ends);
    const left = turns * perTurn(M, axis);
    const back = `After ${turns === 1 ? "one turn" : `${turns} turns`} the body is back`;
    if (Math.abs(left) < 0.05 * DEGREE) return `${back}, and in its computer it is, too.`;
    const where = left > 0 ? "too far" : "short of it";
    const far = `${degrees(Math.abs(left))} ${where}`;
    if (Math.abs(left) <= Math.PI) return `${back}; its computer believes it ${far}.`;
    const apart = degrees(error(M, axis, 2 * Math.PI * turns)); // no two are more than 180° apart
    return `${back}; its computer has it ${far}, which leaves the two attitudes ${apart} apart.`;
  }

  function sayNumbers() {
    const small = perTurn(errors(ends, 1 / TIMES), axis);
    const most = Math.max(...[0, 1, 2].map((i) => lean(ends, i)));
    drawn.textContent = `${degrees(perTurn(errors(ends), axis))} a turn`;
    real.textContent = `${arcMinutes(small)} a turn`;
    hourly.textContent = `${degrees(small * 60 * rate.value)} an hour`;
    find(".hero-note").textContent =
      `The picture exaggerates: the gyro that leans most leans ${degrees(most)} here. ${TIMES} ` +
      `times less is ${arcMinutes(most / TIMES)} (minutes of arc; 60′ are 1°), and no eye ` +
      "would see it.";
    tips.forEach((tip, i) => {
      const value = i < 3 ? lean(ends, i) : Math.acos(axis[2]);
      const along = axis.map((x) => number(x, "")).join(", ");
      tip.setAttribute("aria-valuenow", (value / DEGREE).toFixed(1));
      tip.setAttribute("aria-valuetext", i < 3 ? leanInWords(i) : `along ${along}`);
    });
  }

  let later;
  function sayAloud() {
    clearTimeout(later); // only what it came to, not every step of the way
    later = setTimeout(() => {
      find(".hero-aloud").textContent =
        `Drift: ${drawn.textContent} as drawn, ${real.textContent} bent ${TIMES} times less.`;
    }, 700);
  }

  // ---- drawing ---------------------------------------------------------------------------------
  function showMoment() {
    drawMoment(moment, axis, errors(ends));
    slider.value = moment;
    slider.setAttribute("aria-valuetext", `${number(moment, "")} turns`);
    const says = soFar(Math.floor(moment));
    if (find(".hero-says").textContent !== says) find(".hero-says").textContent = says;
  }

  function showAll() {
    const most = drawTriad(ends, axis, errors(ends));
    find(".hero-scale span:last-child").textContent = `at most ${degrees(most)}`;
    sayNumbers();
    showMoment();
  }

  // ---- time ------------------------------------------------------------------------------------
  let last = 0;
  let coming; // the next frame
  function pass(seconds) {
    if (rest > 0) {
      rest -= seconds;
      return;
    }
    if (moment >= TURNS) moment = 0;
    const next = Math.floor(moment) + 1;
    moment = Math.min(next, moment + seconds / SECONDS);
    if (moment === next) rest = next < TURNS ? REST : 3 * REST;
    showMoment();
  }

  function frame(now) {
    if (!playing || !visible) return;
    pass(Math.min(0.05, (now - last) / 1000));
    last = now;
    coming = requestAnimationFrame(frame);
  }

  function run() {
    play.textContent = playing ? "Pause" : "Play";
    last = performance.now();
    cancelAnimationFrame(coming); // or there would be two of them from now on
    if (playing && visible) coming = requestAnimationFrame(frame);
  }

  // ---- hand and keys ---------------------------------------------------------------------------
  function moveTo(i, place) {
    if (i < 3) ends[i] = bentTo(i, place);
    else axis = place;
    showAll();
    sayAloud();
  }

  const KEYS = {
    ArrowLeft: [UP, -1],
    ArrowRight: [UP, 1],
    ArrowUp: [SIDE, -1],
    ArrowDown: [SIDE, 1],
  };
  tips.forEach((tip, i) => {
    tip.addEventListener("pointerdown", (event) => {
      tip.setPointerCapture(event.pointerId);
      event.preventDefault();
    });
    tip.addEventListener("pointermove", (event) => {
      const held = tip.hasPointerCapture(event.pointerId);
      if (held) moveTo(i, placeAt(i, event.clientX, event.clientY));
    });
    tip.addEventListener("keydown", (event) => {
      if (!KEYS[event.key]) return;
      event.preventDefault();
      const [about, sense] = KEYS[event.key];
      const step = sense * (i < 3 ? 1 : 3) * DEGREE;
      const place = turned([...ends, axis][i], about.map((x) => x * step));
      if (dot(place, TOWARDS) > 0) moveTo(i, place);
    });
  });

  slider.addEventListener("input", () => {
    playing = false;
    moment = Number(slider.value);
    run();
    showMoment();
  });
  rate.addEventListener("change", () => sayNumbers());
  find(".hero-buttons").addEventListener("click", (event) => {
    const what = event.target.dataset.do;
    if (what === "play") {
      playing = !playing;
      run();
    } else if (what === "begin") {
      begin();
      showAll();
      sayAloud();
    } else if (what) {
      const found = Drift[what](errors(ends), errors(ends, 1 / TIMES), TOWARDS);
      moveTo(3, dot(found, TOWARDS) < 0 ? found.map((x) => -x) : found);
    }
  });

  begin();
  if (!playing) moment = 3; // who wants little motion finds something to see
  showAll();
  run();
  new IntersectionObserver(([seen]) => {
    visible = seen.isIntersecting;
    run();
  }).observe(hero);
})();
