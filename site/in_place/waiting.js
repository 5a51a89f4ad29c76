// What a reader sees while Python comes or works: what is done, how much of how much, and Stop.

import { stop } from "./python.js";
import { make } from "./controls.js";

const MEGABYTE = 1e6;

export class Waiting {
  constructor() {
    this.says = make("span", { role: "status" });
    this.amount = make("span", { className: "in-place-amount", ariaHidden: "true" });
    this.bar = make("progress", { ariaLabel: "fetched", hidden: true });
    const button = make("button", { type: "button", onclick: () => stop() }, "Stop");
    this.root = make("div", { className: "in-place-waiting" },
      this.says, this.amount, this.bar, button);
    this.show({ says: "Waiting for Python", loaded: 0, total: 0 });
  }

  // To be handed to `ask` as its onProgress.
  show = ({ says, loaded, total }) => {
    if (this.says.textContent !== says) this.says.textContent = says;
    const going = loaded < total;
    this.bar.hidden = !total;
    if (total) Object.assign(this.bar, { value: loaded, max: total });
    this.amount.textContent = going
      ? `${(loaded / MEGABYTE).toFixed(0)} of ${(total / MEGABYTE).toFixed(0)} MB`
      : "";
  };
}
