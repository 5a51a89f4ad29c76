// ipywidgets gives the handle of a slider no name, and of its value it may say the position in a
// list or a float's last digits; a picture has no alternative text. Here a screen reader gets what
// stands in the label's tooltip and in the readout, and a picture has the title of its panel. One
// observer does it for all panels, whenever and wherever the page shows one. And what is typed in a
// panel is for the panel: JupyterLab would take an arrow or a letter for one of its commands and go
// to the next cell, or cut this one.
if (!window.driftlabNames) {
  const set = (element, attribute, text) => {
    if (element.getAttribute(attribute) !== text) element.setAttribute(attribute, text);
  };
  const nameAll = () => {
    for (const panel of document.querySelectorAll(".driftlab-panel")) {
      const title = panel.querySelector("b");
      const picture = panel.querySelector("img");
      if (title && picture) set(picture, "alt", title.textContent);
      const takesKeys = "select, button, input, .noUi-handle, [contenteditable]";
      for (const element of panel.querySelectorAll(takesKeys)) {
        set(element, "data-lm-suppress-shortcuts", "true");
      }
      for (const slider of panel.querySelectorAll(".widget-slider")) {
        const name = slider.querySelector("label").title;
        const handle = slider.querySelector(".noUi-handle");
        const readout = slider.querySelector(".widget-readout");
        set(handle, "aria-label", name);
        set(handle, "aria-valuetext", readout.textContent);
        set(readout, "role", "textbox");
        set(readout, "aria-label", name);
      }
    }
  };
  window.driftlabNames = new MutationObserver(nameAll);
  window.driftlabNames.observe(document.body, {
    attributeFilter: ["aria-valuetext"],
    childList: true,
    subtree: true,
  });
  nameAll();
}
