// What a panel needs of the page that it stands in. Each panel brings this along; what serves all of
// them is set up by the first, whenever and wherever the page shows one.

const PANEL = ".driftlab-panel";
const readoutOf = (node) => node.closest?.(`${PANEL} .widget-readout`);
const set = (element, attribute, text) => {
  if (element && element.getAttribute(attribute) !== text) element.setAttribute(attribute, text);
};

// The handle of a slider has no name, and of its value it may say the position in a list or a
// float's last digits; a picture has no alternative text. Here the name is what stands in the
// label's tooltip, the value what stands in the readout, and the picture's text comes from Python.
function nameAll() {
  for (const panel of document.querySelectorAll(PANEL)) {
    const page = panel.querySelector(".driftlab-page");
    if (page) set(panel.querySelector("img"), "alt", page.dataset.alt);
    // Who hears the page is told the results each time they change, and once.
    const headline = panel.querySelector(".driftlab-headline");
    set(headline, "aria-live", "polite");
    set(headline, "aria-atomic", "true");
    for (const slider of panel.querySelectorAll(".widget-slider")) {
      const name = slider.querySelector("label").title;
      const handle = slider.querySelector(".noUi-handle, .ui-slider-handle");  // of ipywidgets 8, 7
      const readout = slider.querySelector(".widget-readout");
      set(handle, "aria-label", name);
      set(handle, "aria-valuetext", readout.textContent);
      if (slider.matches(".driftlab-stops")) {  // what is typed there counts for nothing
        set(readout, "contenteditable", "false");
        continue;
      }
      set(readout, "role", "textbox");
      set(readout, "aria-label", name);
    }
  }
}

function serveAllPanels() {
  if (window.driftlabPanels) return;
  window.driftlabPanels = new MutationObserver(nameAll);
  window.driftlabPanels.observe(document.body, {
    attributeFilter: ["aria-valuetext", "data-alt"],
    childList: true,
    subtree: true,
  });

  // At the window, which hears of a key before JupyterLab does. JupyterLab would take an arrow or a
  // letter for one of its commands and go to the next cell, or cut this one; Ctrl+S stays its own.
  window.addEventListener("keydown", (event) => {
    if (!event.target.closest?.(PANEL)) return;
    const forPanel = !(event.ctrlKey || event.metaKey || event.altKey);
    event.target.toggleAttribute("data-lm-suppress-shortcuts", forPanel);
    const readout = readoutOf(event.target);
    if (readout && event.key === "Enter") {
      readout.textContent = readout.textContent.replace(",", ".");
    }
  }, true);

  // A number typed over a readout counts when the reader leaves it, not with Enter only: ipywidgets
  // waits for a blur that comes up to the slider, and a real one does not.
  window.addEventListener("focusout", (event) => {
    readoutOf(event.target)?.dispatchEvent(new FocusEvent("blur", { bubbles: true }));
  });
}

// Whether light letters stand on a dark ground, by the first ground that is not transparent.
function isDark(element) {
  for (let node = element; node; node = node.parentElement) {
    const ground = getComputedStyle(node).backgroundColor.match(/[\d.]+/g) ?? [0, 0, 0, 0];
    const [red, green, blue, alpha = 1] = ground.map(Number);
    if (alpha > 0.5) return 0.3 * red + 0.6 * green + 0.1 * blue < 128;
  }
  return false;
}

function render({ model, el }) {
  serveAllPanels();
  el.classList.add("driftlab-page");
  const sayAlt = () => { el.dataset.alt = model.get("alt"); };
  model.on("change:alt", sayAlt);
  sayAlt();

  const watched = [];
  let ended = false;
  const begin = () => {
    const panel = el.closest(PANEL);
    if (ended) return;
    if (!panel) {  // not in the page yet
      requestAnimationFrame(begin);
      return;
    }
    nameAll();
    model.set("ratio", window.devicePixelRatio);
    model.save_changes();

    const colour = () => panel.isConnected && panel.classList.toggle("driftlab-dark", isDark(panel));
    const themes = new MutationObserver(() => setTimeout(colour, 200));  // when it has been loaded
    themes.observe(document.body, { attributes: true });
    const system = window.matchMedia("(prefers-color-scheme: dark)");
    system.addEventListener("change", colour);
    colour();
    watched.push(() => themes.disconnect(), () => system.removeEventListener("change", colour));

    // Where a notebook scrolls in a frame of its own, a panel is no higher than this frame.
    const frame = panel.closest(".jp-WindowedPanel-outer");
    if (!frame) return;
    const measure = () => panel.style.setProperty("--driftlab-room", `${frame.clientHeight}px`);
    const sizes = new ResizeObserver(measure);
    sizes.observe(frame);
    measure();
    watched.push(() => sizes.disconnect());
  };
  begin();
  return () => {
    ended = true;
    model.off("change:alt", sayAlt);
    watched.forEach((stop) => stop());
  };
}

export default { render };
