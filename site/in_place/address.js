// The state of a panel as an address: its class, which of them on the page if there are several, and
// the values of all its controls. offer.js reads it.

export function linkTo(figure) {
  const { panel, values } = figure.dataset;
  const all = [...document.querySelectorAll("figure.driftlab-still[data-panel]")];
  const number = all.filter((each) => each.dataset.panel === panel).indexOf(figure) + 1;
  const state = new URLSearchParams({ panel: number > 1 ? `${panel}.${number}` : panel });
  for (const [name, value] of Object.entries(JSON.parse(values))) state.set(name, value);
  const address = new URL(location.href);
  address.hash = state;
  return address.href;
}
