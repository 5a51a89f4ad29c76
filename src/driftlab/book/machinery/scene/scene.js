// The whole scene: views, curves and numbers under one time, which plays, stops and is dragged.

class Scene {
  constructor(model, root) {
    this.model = model;
    this.moment = 0;
    root.classList.add("dl-scene");
    root.setAttribute("data-lm-suppress-shortcuts", "true"); // or JupyterLab would take the keys
    const stage = make(root, "div", { class: "dl-stage" });
    this.viewsBox = make(stage, "div", { class: "dl-views" });
    const side = make(stage, "div", { class: "dl-side" });
    this.plotsBox = make(side, "div", { class: "dl-plots" });
    this.table = make(side, "table", { class: "dl-readouts" });
    const bar = make(root, "div", { class: "dl-bar" });
    this.button = make(bar, "button", { type: "button" });
    this.slider = make(bar, "input", { type: "range", min: 0, step: 1, "aria-label": "time" });
    this.clock = make(bar, "output");
    this.views = [];
    this.plots = [];
    this.button.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    this.slider.addEventListener("input", () => this.goTo(Number(this.slider.value)));
    root.addEventListener("keydown", (event) => {
      if (event.key !== " " || event.target === this.button) return;
      event.preventDefault();
      this.button.click();
    });
    // A handle asks for one stage at a time, and for the last place that it was dragged to.
    this.listeners = {
      "msg:custom": () => this.answered(),
      "change:stage": () => this.take(),
      "change:moment": () => this.goTo(model.get("moment"), false),
      "change:busy": () => {
        root.classList.toggle("dl-busy", model.get("busy"));
        root.setAttribute("aria-busy", model.get("busy"));
      },
    };
    for (const [event, listener] of Object.entries(this.listeners)) model.on(event, listener);
    this.take();
    this.goTo(model.get("moment"), false);
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (model.get("autoplay") && !calm) {
      this.watch = new IntersectionObserver(([seen]) => {
        if (!seen.isIntersecting) return;
        this.watch.disconnect();
        this.play();
      }, { threshold: 0.5 });
      this.watch.observe(root);
    }
  }

  take() {
    this.stage = unpack(this.model.get("stage"));
    const { views, plots, readouts, times } = this.stage;
    this.slider.max = times.length - 1;
    fit(this.views, views, () => new ViewOfSpace(this.viewsBox, this));
    fit(this.plots, plots, () => new PlotOfTime(this.plotsBox, this));
    this.table.replaceChildren();
    this.cells = readouts.map((each) => {
      const row = make(this.table, "tr");
      make(row, "th", { scope: "row" }, each.name);
      return make(row, "td").appendChild(new Text("")); // whose change nobody observes
    });
    this.draw();
  }

  // Move to a moment; `tell` the kernel unless it is the one that asked.
  goTo(moment, tell = true) {
    this.pause(false);
    this.moment = Math.max(0, Math.min(this.stage.times.length - 1, moment));
    this.draw();
    if (tell) this.tell();
  }

  tell() {
    this.model.set("moment", this.moment);
    this.model.save_changes();
  }

  draw() {
    const { times, timeUnit, readouts } = this.stage;
    this.moment = Math.min(this.moment, times.length - 1);
    const k = this.moment;
    for (const each of [...this.views, ...this.plots]) each.draw(k);
    readouts.forEach((each, i) => {
      const value = each.values[k];
      this.cells[i].nodeValue = Number.isNaN(value)
        ? "–"
        : each.words[value] ?? `${signless(value.toFixed(each.decimals))}${each.unit}`;
    });
    const range = Math.abs(times.at(-1) - times[0]);
    this.clock.textContent = `${times[k].toFixed(range > 30 ? 1 : 2)} ${timeUnit}`;
    this.slider.value = k;
    this.slider.setAttribute("aria-valuetext", this.clock.textContent);
    const next = k === times.length - 1 ? "↺ Again" : "▶ Play";
    this.button.textContent = this.playing ? "❚❚ Pause" : next;
  }

  play() {
    const last = this.stage.times.length - 1;
    let place = this.moment === last ? 0 : this.moment;
    let before = null;
    this.table.removeAttribute("aria-live"); // nobody can follow sixty numbers a second
    const step = (now) => {
      place += before === null ? 0 : ((now - before) / 1000 / this.stage.seconds) * last;
      before = now;
      this.moment = Math.min(last, Math.floor(place));
      if (this.moment === last) this.pause();
      else this.playing = requestAnimationFrame(step);
      this.draw();
    };
    this.playing = requestAnimationFrame(step);
  }

  pause(tell = true) {
    if (!this.playing) return;
    cancelAnimationFrame(this.playing);
    this.playing = null;
    this.table.setAttribute("aria-live", "polite");
    this.draw();
    if (tell) this.tell();
  }

  ask(message) {
    this.pause();
    this.next = message;
    if (!this.asking) this.answered();
  }

  answered() {
    this.asking = this.next;
    this.next = null;
    if (this.asking) this.model.send(this.asking);
  }

  end() {
    if (this.playing) cancelAnimationFrame(this.playing);
    this.watch?.disconnect();
    for (const [event, listener] of Object.entries(this.listeners)) this.model.off(event, listener);
  }
}

const signless = (text) => (/[1-9]/.test(text) ? text.replace("-", "−") : text.replace("-", ""));

const fit = (made, wanted, makeOne) => {
  while (made.length > wanted.length) made.pop().root.remove();
  while (made.length < wanted.length) made.push(makeOne());
  made.forEach((each, i) => each.update(wanted[i]));
};

export default {
  render({ model, el }) {
    const scene = new Scene(model, el);
    el.driftlab = scene; // for the tests
    return () => scene.end();
  },
};
