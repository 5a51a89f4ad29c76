// Below all exercises of a page: how the book's exercises stand, and the reader's answers as a
// notebook, to take along or to hand in.
import { fileName, notebook } from "./answers_notebook.js";
import { download, make } from "./elements.js";
import { BLOCKED } from "./kept.js";

// Its parts stay while their words change, or a click would lose the button under it.
export class End {
  #words = make("p");
  #blocked = make("p", { textContent: BLOCKED, hidden: true });
  #name = make("input", { type: "text", autocomplete: "name", maxLength: 80 });
  #button = make("button", { type: "submit", textContent: "Export my answers" });

  constructor(kept, numbers, version) {
    Object.assign(this, { kept, numbers });
    const name = make("label", {}, "Your name, if it should stand in the notebook ", this.#name);
    this.#name.value = kept.of("reader").name ?? "";
    this.#name.onchange = () => kept.put("reader", "name", this.#name.value.trim());
    const form = make("form", { className: "answer answers-export" }, name, this.#button);
    form.onsubmit = (event) => {
      event.preventDefault();
      if (this.answered.length) this.#hand(this.#name.value.trim(), version);
    };
    const title = make("h3", { id: "your-answers", textContent: "Your answers" });
    this.root = make("section", { className: "answers-end" },
      title, this.#words, this.#blocked, form);
    this.root.setAttribute("aria-labelledby", title.id);
  }

  // Numbers of exercises, and what is kept of them.
  get answered() {
    const mine = this.kept.of("exercises");
    return this.numbers.filter((number) => typeof mine[number]?.cell === "string").map((n) => [n, mine[n]]);
  }

  tell() {
    const { answered, numbers } = this;
    const right = answered.filter(([, mine]) => mine.right).length;
    this.#words.textContent =
      "The export is a notebook of what you have answered in the whole book and what was said to " +
      "it: to keep, to go on with in Jupyter, or to hand in. " + (answered.length
        ? `So far ${answered.length} of ${numbers.length} exercises, ${right} of them right.`
        : "So far you have answered none.") +
      (this.kept.blocked ? "" : " Answers and name are kept in this browser, and nowhere else.");
    this.#blocked.hidden = !this.kept.blocked;
    this.#button.disabled = !answered.length;
  }

  #hand(name, version) {
    const made = JSON.stringify(notebook(this.answered, name, version), null, 1);
    download(fileName(name), "application/x-ipynb+json", made);
  }
}
