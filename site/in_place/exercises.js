// The exercises of a page: a form below each, which answers back by the page's Python.
import { Asking, data } from "./asking.js";
import { make } from "./elements.js";
import { End } from "./export.js";
import { AnswerForm } from "./form.js";
import { Kept } from "./kept.js";

const SIGNS = { true: "✓ Right", false: "✗ Not yet" };

export async function begin() {
  const places = [...document.querySelectorAll("div.exercise[data-exercise]")];
  const { version, exercises } = await data("exercises");
  const kept = new Kept(version);
  const end = new End(kept, Object.keys(exercises), version);
  for (const place of places) {
    const number = place.dataset.exercise;
    new Exercise(place, number, exercises[number], kept, () => end.tell());
  }
  places.at(-1)?.closest("section")?.after(end.root); // below the exercises, not in the last one
  end.tell();
}

class Exercise {
  constructor(place, number, form, kept, tell) {
    Object.assign(this, { place, number, kept, tell });
    this.asking = new Asking("What you typed is still here.");
    this.form = new AnswerForm(number, form, this.asking.stop);
    this.printed = make("pre", { className: "answer-printed", hidden: true, tabIndex: 0 });
    this.printed.setAttribute("aria-label", `What your lines for exercise ${number} printed`);
    // It is there before its text is, or a screen reader would say nothing of it.
    this.card = make("div", { className: "answer-card", ariaLive: "polite" });
    place.replaceChildren(this.form.root, this.asking.root, this.printed, this.card);
    this.form.onTyped = (typed) => this.#keep({ typed });
    this.form.onAnswer = (answer) => this.check(answer);
    try {
      this.#restore();
    } catch {
      // What is kept was written by hand, or elsewhere.
    }
  }

  get mine() {
    return this.kept.of("exercises")[this.number] ?? {};
  }

  #keep(more) {
    this.kept.put("exercises", this.number, { ...this.mine, ...more });
    this.tell();
  }

  #restore() {
    const { typed, checked, right } = this.mine;
    if (typed) this.form.show(typed);
    // Not of what was typed since, or could not be read.
    if (right != null && JSON.stringify(checked) === JSON.stringify(typed))
      this.card.append(
        make("p", { className: `answer-before ${right ? "right" : "not-yet"}` },
          make("b", { textContent: SIGNS[right] }), " when you last checked it."));
  }

  async check(answer) {
    if (answer.way === "panel" && !(answer = panelAbove(this.place))) {
      this.asking.say("There is no panel above this exercise.");
      return;
    }
    this.form.busy = true;
    this.card.replaceChildren();
    this.printed.hidden = true;
    const { way, given, panel = "", because = "" } = answer;
    const result = await this.asking.for("exercises.check",
      [this.number, way, given, this.#progress(), panel, because]);
    this.form.busy = false;
    if (this.asking.stopped) this.form.button.focus({ preventScroll: true }); // Stop is gone
    if (!result) return;
    this.card.innerHTML = result.card;
    this.card.dataset.verdict = result.right ?? "open";
    this.printed.textContent = result.printed;
    this.printed.hidden = !result.printed;
    const { right, guesses, tried } = result.progress;
    const { typed } = this.form;
    const judged = result.cell && { // what could not be read takes no earlier answer's place
      checked: typed,
      cell: result.cell, says: result.says, record: result.record,
      right: right[this.number], guess: guesses[this.number], tried: tried[this.number],
    };
    this.#keep({ typed, ...judged });
  }

  // What the package must know of the chapter to say how it stands.
  #progress() {
    const progress = { right: {}, guesses: {}, tried: {} };
    const chapter = `${this.number.split(".")[0]}.`;
    for (const [number, { right, guess, tried }] of Object.entries(this.kept.of("exercises"))) {
      if (!number.startsWith(chapter)) continue;
      if (right != null) progress.right[number] = right;
      if (guess != null) progress.guesses[number] = guess;
      if (tried != null) progress.tried[number] = tried;
    }
    return progress;
  }
}

// The values of the panel that stands last before the exercise.
function panelAbove(place) {
  const above = [...document.querySelectorAll("figure.driftlab-still[data-panel]")].filter(
    (figure) => figure.compareDocumentPosition(place) & Node.DOCUMENT_POSITION_FOLLOWING);
  const figure = above.at(-1);
  return figure && {
    way: "panel", given: JSON.parse(figure.dataset.values), panel: figure.dataset.panel,
  };
}
