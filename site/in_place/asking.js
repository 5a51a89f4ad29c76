// A question to the page's Python: what is said while it works, a way to stop it, and one sentence
// if it fails.
import { make } from "./elements.js";
import { ask, stop } from "./python.js";

export class Asking {
  #words = make("span", { role: "status" });
  root = make("p", { className: "answer-says" }, this.#words);
  stop = make("button", { type: "button", textContent: "Stop", hidden: true });

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
      this.stop.hidden = true;
    }
  }

  // Python says if it needs a package that is not loaded yet; it is asked again with it.
  async #withPackages(call, args) {
    let packages = [];
    for (;;) {
      const onProgress = (says) => this.say(`${says} …`);
      const result = await ask(call, args, { onProgress, packages });
      if (!result?.needs) return result;
      if (packages.includes(result.needs)) throw new Error(`${result.needs} could not be loaded.`);
      packages = [result.needs];
    }
  }
}

// The forms' data, which the build writes, and their style.
export async function data(name) {
  const style = new URL("answers.css", import.meta.url).href;
  if (!document.querySelector(`link[href="${style}"]`))
    document.head.append(make("link", { rel: "stylesheet", href: style }));
  const answer = await fetch(new URL(`${name}.json`, import.meta.url)).catch(() => null);
  if (!answer?.ok) throw new Error(`${name}.json could not be fetched. Are you offline?`);
  return answer.json();
}
