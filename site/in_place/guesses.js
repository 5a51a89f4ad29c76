// The puzzles of a page: first a guess, then the answer, which the page's Python computes. The
// guess that was made first is kept.
import { Asking, data } from "./asking.js";
import { make } from "./elements.js";
import { BLOCKED, Kept } from "./kept.js";

const UNANSWERED =
  "Move each slider, or type a number, and choose an answer where there is a choice. " +
  "Then it is a guess.";

export async function begin() {
  const { version, puzzles } = await data("puzzles");
  const kept = new Kept(version);
  for (const place of document.querySelectorAll("div.guess[data-guess]")) {
    const chapter = place.dataset.guess;
    new Guess(place, chapter, puzzles[chapter], kept);
  }
  for (const place of document.querySelectorAll("div.guesses")) offerLookBack(place, kept);
}

// Whether what is kept is a guess at this puzzle, or a look without one.
function fits(guess, { questions }) {
  return guess === null || (guess.length === questions.length &&
    questions.every(({ options, low, high }, i) =>
      options ? options.includes(guess[i]) : low <= guess[i] && guess[i] <= high));
}

class Guess {
  constructor(place, chapter, puzzle, kept) {
    Object.assign(this, { place, chapter, puzzle, kept, asking: new Asking() });
    const before = kept.of("guesses")[puzzle.key];
    if (before === undefined || !fits(before, puzzle)) this.#ask();
    else this.#remind(before);
  }

  #ask() {
    const { chapter, puzzle } = this;
    this.inputs = puzzle.questions.map((question, i) =>
      question.options
        ? new ChoiceInput(question, `guess-${chapter}-${i}`)
        : new NumberInput(question));
    const look = make("button", { type: "button", textContent: "Show me",
      title: "See the answer without a guess; that is possible too" });
    look.onclick = () => this.#make(null);
    const mine = make("button", {
      type: "submit", className: "answer-check", textContent: "That is my guess" });
    const form = make("form", { className: "answer" },
      make("p", {}, make("b", { textContent: "A guess first." })),
      ...this.inputs.map((input) => input.root),
      make("div", { className: "answer-buttons" }, mine, look));
    form.onsubmit = (event) => {
      event.preventDefault();
      const guess = this.inputs.map((input) => input.value);
      if (guess.includes(null)) this.asking.say(UNANSWERED);
      else this.#make(guess);
    };
    this.place.replaceChildren(form, this.asking.root);
  }

  #make(guess) {
    this.kept.put("guesses", this.puzzle.key, guess);
    this.#reveal(guess, this.kept.blocked ? BLOCKED : "");
  }

  // What was guessed at another time; Python comes only if the reader wants the answer again.
  #remind(guess) {
    const words = guess
      ? this.puzzle.questions.map(({ asks, unit = "" }, i) =>
        make("p", {}, `${asks} Your guess: `,
          make("b", { textContent: `${guess[i]} ${unit}`.trim() })))
      : [make("p", { textContent: "You looked at the answer of this puzzle." })];
    const show = make("button", {
      type: "button", className: "answer-check", textContent: "Show the answer" });
    const note = guess ? "This is the guess that you made first; it is kept in this browser." : "";
    show.onclick = () => this.#reveal(guess, note);
    this.place.replaceChildren(
      ...words, make("div", { className: "answer-buttons" }, show), this.asking.root);
  }

  async #reveal(guess, note) {
    // If Python does not come, the guess and the way to its answer stand here.
    this.#remind(guess);
    this.place.querySelector(".answer-check").hidden = true;
    this.place.querySelector(".answer-buttons").append(this.asking.stop);
    const answer = make("div", { className: "guess-answer", tabIndex: -1 });
    const html = await this.asking.for("guesses.reveal", [this.chapter, guess, note]);
    if (html === null) {
      this.place.querySelector(".answer-check").hidden = false;
      return;
    }
    this.place.replaceChildren(answer);
    answer.innerHTML = html;
    answer.focus({ preventScroll: true }); // where the button was that had it
  }
}

// A field for the keyboard and a slider; they move together.
class NumberInput {
  #touched = false; // where the slider stands at first is nobody's guess

  constructor({ asks, unit, low, high, start, whole }) {
    const ratio = Math.log(high / low);
    const place = (value) => (whole ? value : Math.log(value / low) / ratio);
    const at = (slid) => (whole ? slid : Number((low * Math.exp(ratio * slid)).toPrecision(2)));
    this.field = make("input", {
      type: "number", min: low, max: high, step: whole ? 1 : "any", value: start, required: true });
    const [least, most, step] = whole ? [low, high, 1] : [0, 1, 0.005];
    const slider = make("input", {
      type: "range", min: least, max: most, step, value: place(start),
      ariaLabel: `${asks} ${unit}`, className: "guess-slider" });
    const say = () => slider.setAttribute("aria-valuetext", `${this.field.value} ${unit}`);
    slider.oninput = () => {
      this.#touched = true;
      this.field.value = at(Number(slider.value));
      say();
    };
    this.field.oninput = () => {
      this.#touched = true;
      if (this.field.validity.valid) slider.value = place(this.field.valueAsNumber);
      say();
    };
    say();
    this.root = make("fieldset", {}, make("legend", { textContent: asks }),
      make("label", { className: "guess-number" }, "Your guess ", this.field, ` ${unit}`),
      slider);
  }

  get value() {
    return this.#touched ? this.field.valueAsNumber : null;
  }
}

// Buttons for the answers of one question; none is chosen at first.
class ChoiceInput {
  constructor({ asks, options }, name) {
    this.radios = options.map((value) => make("input", { type: "radio", name, value }));
    this.root = make("fieldset", {}, make("legend", { textContent: asks }),
      ...this.radios.map((radio) =>
        make("label", { className: "guess-option" }, radio, ` ${radio.value}`)));
  }

  get value() {
    return this.radios.find((radio) => radio.checked)?.value ?? null;
  }
}

// All guesses beside their truths, when the reader asks for them.
function offerLookBack(place, kept) {
  const asking = new Asking();
  const table = make("div", { className: "guess-answer", ariaLive: "polite" });
  const button = make("button", { type: "button", textContent: "Look back at my guesses" });
  button.onclick = async () => {
    button.disabled = true;
    table.innerHTML = (await asking.for("guesses.look_back", [kept.of("guesses")])) ?? "";
    button.disabled = false;
  };
  place.replaceChildren(
    make("div", { className: "answer-buttons" }, button, asking.stop), asking.root, table);
}
