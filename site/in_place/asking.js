// A question to the page's Python: what is said while it works, a way to stop it, and one sentence
// if it fails.
import { ask, stop } from "./python.js";

export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

export class Asking {
  #words = element("span", { role: "status" });
  #much = element("span"); // apart from the words, which a screen reader reads out when they change
  #bar = element("progress", { ariaLabel: "Fetched", hidden: true });
  root = element("p", { className: "answer-says" }, this.#words, this.#much, this.#bar);
  stop = element("button", { type: "button", textContent: "Stop", hidden: true });

  constructor(kept = "") {
    this.stop.onclick = () => {
      this.stopped = `Stopped. ${kept}`;
      stop();
    };
  }

  say(words) {
    if (this.#words.textContent !== words) this.#words.textContent = words;
  }

  // The result, or null if there is none; then the sentence stands in the page.
  async for(call, args) {
    this.stopped = "";
    this.stop.hidden = false;
    this.say("Python is at work …");
    try {
      const result = await this.#withPackages(call, args);
      this.say("");
      return result;
    } catch (error) {
      this.say(this.stopped || error.message);
      return null;
    } finally {
      this.stop.hidden = this.#bar.hidden = true;
      this.#much.textContent = "";
    }
  }

  // Python says if it needs a package that is not loaded yet; it is asked again with it.
  async #withPackages(call, args) {
    const onProgress = (progress) => this.#show(progress);
    let packages = [];
    for (;;) {
      const result = await ask(call, args, { onProgress, packages });
      if (!result?.needs) return result;
      if (packages.includes(result.needs)) throw new Error(`${result.needs} could not be loaded.`);
      packages = [result.needs];
    }
  }

  #show({ says, loaded, total }) {
    const fetching = loaded < total;
    const megabytes = (bytes) => Math.round(bytes / 1e6);
    this.say(`${says} …`);
    this.#much.textContent = fetching ? ` ${megabytes(loaded)} of ${megabytes(total)} MB ` : "";
    this.#bar.hidden = !fetching;
    Object.assign(this.#bar, { max: total || 1, value: loaded });
  }
}

// The forms' data, which the build writes, and their style.
export async function data(name) {
  const style = new URL("answers.css", import.meta.url).href;
  if (!document.querySelector(`link[href="${style}"]`))
    document.head.append(element("link", { rel: "stylesheet", href: style }));
  const answer = await fetch(new URL(`${name}.json`, import.meta.url)).catch(() => null);
  if (!answer?.ok) throw new Error(`${name}.json could not be fetched. Are you offline?`);
  return answer.json();
}
