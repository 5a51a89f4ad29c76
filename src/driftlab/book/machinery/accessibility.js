// What ipywidgets leaves undone for readers who use the keyboard or a screen reader. One observer
// and one pair of listeners serve all panels, whenever and wherever the page shows one.
if (!window.driftlabAccessibility) {
  const readoutOf = (node) => node.closest?.(".driftlab-panel .widget-readout");
  const set = (element, attribute, text) => {
    if (element.getAttribute(attribute) !== text) element.setAttribute(attribute, text);
  };

  // The handle of a slider has no name, and of its value it may say the position in a list or a
  // float's last digits; a picture has no alternative text. Here the name is what stands in the
  // label's tooltip, the value what stands in the readout, and a picture has its panel's title.
  const nameAll = () => {
    for (const panel of document.querySelectorAll(".driftlab-panel")) {
      const title = panel.querySelector("b");
      const picture = panel.querySelector("img");
      if (title && picture) set(picture, "alt", title.textContent);
      for (const slider of panel.querySelectorAll(".widget-slider")) {
        const name = slider.querySelector("label").title;
        const handle = slider.querySelector(".noUi-handle");
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
  };
  window.driftlabAccessibility = new MutationObserver(nameAll);
  window.driftlabAccessibility.observe(document.body, {
    attributeFilter: ["aria-valuetext"],
    childList: true,
    subtree: true,
  });
  nameAll();

  // At the window, which hears of a key before JupyterLab does. JupyterLab would take an arrow or a
  // letter for one of its commands and go to the next cell, or cut this one; Ctrl+S stays its own.
  window.addEventListener("keydown", (event) => {
    if (!event.target.closest?.(".driftlab-panel")) return;
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
