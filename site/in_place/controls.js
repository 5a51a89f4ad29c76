// Native controls for the widgets of a panel, each with its label, its full name for screen readers,
// and its value. What brings its own script is drawn by that script.

import { make } from "./elements.js";

let count = 0;

// Show a model; returns its element. `ends` collects what is to be called at its end.
export function show(model, ends) {
  const element = KINDS[model.kind](model, ends);
  element.classList.add(...(model.get("classes") ?? []));
  const layout = model.get("layout");
  follow(layout, "display", (display) => (element.hidden = display === "none"));
  return element;
}

const KINDS = {
  VBox: (model, ends) => box(model, "in-place-column", ends),
  HBox: (model, ends) => box(model, "in-place-row", ends),
  Box: (model, ends) => box(model, "in-place-box", ends),

  HTML(model) {
    const element = make("div", { className: "in-place-html" });
    follow(model, "value", (value) => {
      element.innerHTML = value;
      for (const trace of element.querySelectorAll("pre.driftlab-error")) fold(trace);
      // Lines that are longer than the page is wide are scrolled by keys too.
      for (const lines of element.querySelectorAll("pre")) lines.tabIndex = 0;
    });
    return element;
  },

  Image(model, ends) {
    const element = make("img", { alt: "", width: model.get("width") });
    let address = "";
    const forget = () => URL.revokeObjectURL(address);
    follow(model, "value", (value) => {
      forget();
      address = URL.createObjectURL(new Blob([value], { type: `image/${model.get("format")}` }));
      element.src = address;
    });
    ends.push(forget);
    return element;
  },

  Button(model) {
    const button = make("button", { type: "button", title: model.get("tooltip") ?? "" });
    button.textContent = model.get("description");
    button.onclick = () => model.send({ pressed: true });
    return button;
  },

  Checkbox(model) {
    const input = make("input", { type: "checkbox" });
    name(input, model);
    input.onchange = () => tell(model, "value", input.checked);
    follow(model, "value", (value) => (input.checked = value));
    return make("label", { className: "in-place-check" }, input, model.get("description"));
  },

  Text(model) {
    const input = make("input", { type: "text", autocapitalize: "off", spellcheck: false });
    input.onchange = () => tell(model, "value", input.value);
    follow(model, "value", (value) => (input.value = value));
    return labelled(model, "in-place-text", input);
  },

  Dropdown(model) {
    const options = model.get("labels").map((label) => make("option", {}, label));
    const select = make("select", {}, ...options);
    select.onchange = () => tell(model, "index", select.selectedIndex);
    follow(model, "index", (index) => (select.selectedIndex = index ?? -1));
    return labelled(model, "in-place-menu", select);
  },

  SelectionSlider(model) {
    const labels = model.get("labels");
    const slider = make("input", { type: "range", min: 0, max: labels.length - 1, step: 1 });
    const readout = make("output");
    slider.oninput = () => tell(model, "index", Number(slider.value));
    follow(model, "index", (index) => {
      slider.value = index;
      readout.textContent = labels[index];
      slider.setAttribute("aria-valuetext", labels[index]);
    });
    return labelled(model, "in-place-slider", slider, readout);
  },

  FloatSlider: (model) => numberSlider(model),
  IntSlider: (model) => numberSlider(model),

  AnyWidget(model, ends) {
    const element = make("div");
    const drawn = scriptOf(model).then((script) => script.render({ model, el: element }));
    ends.push(async () => (await drawn)?.());
    return element;
  },
};

function box(model, className, ends) {
  return make("div", { className }, ...model.get("children").map((child) => show(child, ends)));
}

// A scale, and its number, which can be typed.
function numberSlider(model) {
  const [min, max, step] = ["min", "max", "step"].map((name) => model.get(name));
  const decimals = Number(/\d+/.exec(model.get("readout_format"))?.[0] ?? 0);
  const slider = make("input", { type: "range", min, max, step });
  const readout = make("input", { type: "number", min, max, step });
  const write = (value) => {
    readout.value = value.toFixed(decimals);
    slider.setAttribute("aria-valuetext", readout.value);
  };
  slider.oninput = () => tell(model, "value", Number(slider.value));
  readout.onchange = () => {
    const typed = readout.valueAsNumber;
    const value = Math.max(min, Math.min(max, Number.isNaN(typed) ? model.get("value") : typed));
    if (value === model.get("value")) write(value); // nothing will change, but what was typed
    tell(model, "value", model.kind === "IntSlider" ? Math.round(value) : value);
  };
  name(readout, model);
  follow(model, "value", (value) => {
    slider.value = value;
    write(value);
  });
  return labelled(model, "in-place-slider", slider, readout);
}

// A control after its label; the label is short, its name says the group as well.
function labelled(model, className, control, ...others) {
  control.id = `in-place-${++count}`;
  name(control, model);
  const label = make("label", { htmlFor: control.id }, model.get("description"));
  return make("div", { className }, label, control, ...others);
}

function name(control, model) {
  control.setAttribute("aria-label", model.get("tooltip") || model.get("description"));
}

// Call a function with a part of the state, now and at each change.
function follow(model, name, act) {
  model.on(`change:${name}`, () => act(model.get(name)));
  act(model.get(name));
}

function tell(model, name, value) {
  model.set(name, value);
  model.save_changes();
}

// What nobody foresaw: a sentence, and the traceback for those who want it.
function fold(trace) {
  const last = trace.textContent.trimEnd().split("\n").at(-1);
  const details = make("details", { className: "in-place-trace" }, make("summary", {}, "Traceback"));
  trace.replaceWith(make("p", { role: "alert" }, `This should not have happened. ${last}`), details);
  trace.removeAttribute("role");
  details.append(trace);
}

const scripts = new Map(); // text -> promise of the module
const styles = new Set();

function scriptOf({ script, style }) {
  if (style && !styles.has(style)) {
    styles.add(style);
    document.head.append(make("style", {}, style));
  }
  if (!scripts.has(script)) {
    const address = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    scripts.set(script, import(address).then((module) => module.default));
  }
  return scripts.get(script);
}
