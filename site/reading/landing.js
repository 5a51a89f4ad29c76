// Plays the scene of the first page: LANDING has its presets, as landing.py computed them, and
// `scene` draws them. To drag its handles takes Python, which the button below wakes.

const figure = document.querySelector("figure.driftlab-still");
const listeners = {};
const state = { moment: 0, autoplay: true, busy: false };
const model = {
  get: (name) => state[name],
  set: (name, value) => (state[name] = value),
  on: (event, listener) => (listeners[event] = listener),
  off() {},
  save_changes() {},
};

const packed = (list) => new DataView(Float64Array.from(list).buffer);
const readied = (stage) => ({
  ...stage,
  times: packed(stage.times),
  tracks: Object.fromEntries(Object.entries(stage.tracks).map(([n, track]) => [n, packed(track)])),
  views: stage.views.map((view) => ({
    ...view, parts: view.parts.map((part) => ({ ...part, points: packed(part.points) })),
  })),
  plots: stage.plots.map((plot) => ({
    ...plot,
    curves: plot.curves.map((curve) => ({
      ...curve, values: packed(curve.values), moments: curve.moments && packed(curve.moments),
    })),
  })),
  readouts: stage.readouts.map((each) => ({ ...each, values: packed(each.values) })),
});

make(document.head, "style", {}, LANDING.style);
const choices = make(figure, "div", { class: "landing-choices", role: "group", "aria-label": "axis" });
const root = make(figure, "div");
figure.querySelector("a.picture").replaceWith(choices, root);
const caption = figure.querySelector("figcaption");

function choose(name) {
  const { look, stage } = LANDING.presets[name];
  state.stage = readied(stage);
  caption.textContent = look;
  for (const button of choices.children) {
    button.setAttribute("aria-pressed", button.textContent === name);
  }
}
for (const name of Object.keys(LANDING.presets)) {
  make(choices, "button", { type: "button" }, name).onclick = () => {
    choose(name);
    listeners["change:stage"]();
    root.driftlab.goTo(0);
    root.driftlab.play();
  };
}
choose(choices.firstChild.textContent);
scene.render({ model, el: root });

// Light letters stand on a dark ground, whether the system is dark or the reader's choice.
const colour = () => {
  const [red] = getComputedStyle(document.body).backgroundColor.match(/\d+/g);
  figure.classList.toggle("driftlab-dark", red < 128);
};
new MutationObserver(colour).observe(document.body, { attributes: true });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", colour);
colour();
