// The form of one exercise: letters to tick, a line of numbers, or lines of Python.
import { make } from "./elements.js";

export class AnswerForm {
  onTyped = () => {};
  onAnswer = () => {};

  constructor(number, { way, letters = "", lines, panel = false }, stop) {
    this.way = way;
    this.root = make("form", { className: "answer" });
    this.first = lines ?? "";
    const parts = [];
    if (way === "letters") parts.push(this.#letters(letters), this.#why());
    if (way === "line") parts.push(this.#line(number));
    if (lines !== undefined) parts.push(this.#python(number));
    this.button = make("button", { type: "submit", className: "answer-check" });
    const buttons = make("div", { className: "answer-buttons" }, this.button);
    if (panel) buttons.append(this.#panelButton());
    buttons.append(stop);
    this.root.append(
      make("fieldset", {},
        make("legend", { textContent: `Your answer to ${number}` }), ...parts), buttons);
    this.root.onsubmit = (event) => {
      event.preventDefault();
      if (!this.busy) this.onAnswer(this.answer);
    };
    this.root.onchange = () => this.onTyped(this.typed);
    this.#follow();
  }

  // Everything that stands in the form, and whether Python is unfolded.
  get typed() {
    return {
      letters: this.boxes?.filter((box) => box.checked).map((box) => box.value).join(""),
      line: this.line?.value,
      code: this.code?.value === this.first ? undefined : this.code?.value,
      python: this.fold?.open,
      because: this.because?.value,
    };
  }

  show({ letters = "", line = "", code = this.first, python = false, because = "" }) {
    for (const box of this.boxes ?? []) box.checked = letters.includes(box.value);
    if (this.line) this.line.value = line;
    if (this.code) this.code.value = code;
    if (this.fold) this.fold.open = python;
    if (this.because) this.because.value = because;
    this.#follow();
  }

  get answer() {
    const way = this.inPython ? "code" : this.way;
    return { way, given: this.typed[way] ?? this.first, because: this.typed.because?.trim() };
  }

  get inPython() {
    return this.way === "code" || Boolean(this.fold?.open);
  }

  // A disabled button would lose the focus, so that it only says that it is.
  set busy(busy) {
    this.root.ariaBusy = String(busy);
    for (const button of this.root.querySelectorAll(".answer-check"))
      button.ariaDisabled = String(busy);
  }

  get busy() {
    return this.root.ariaBusy === "true";
  }

  #letters(letters) {
    this.boxes = [...letters].map((value) =>
      make("input", { type: "checkbox", value, ariaLabel: `Statement ${value}` }));
    return this.simple = make("div", { className: "answer-letters" },
      ...this.boxes.map((box) => make("label", {}, box, ` (${box.value})`)));
  }

  #why() {
    this.because = make("textarea", { rows: 2, maxLength: 2000 });
    return make("label", { className: "answer-why" },
      "Why? A sentence of your own; the reply goes into it.", this.because);
  }

  #line(number) {
    this.line = make("input", {
      type: "text", autocapitalize: "off", autocomplete: "off", spellcheck: false,
      ariaLabel: `Numbers, your answer to exercise ${number}`,
    });
    const how = make("small", {
      id: `how-${number}`,
      textContent: "Commas between numbers, semicolons between rows: 1.5, −2e-3, 90/7, sqrt(2)",
    });
    this.line.setAttribute("aria-describedby", how.id);
    return this.simple = make("div", { className: "answer-line" }, this.line, how);
  }

  #python(number) {
    this.code = make("textarea", {
      value: this.first, rows: this.first.split("\n").length + 2, spellcheck: false,
      autocapitalize: "off", ariaLabel: `Python for exercise ${number}`,
    });
    this.code.onkeydown = (event) => {
      if (event.key !== "Enter" || !(event.ctrlKey || event.shiftKey || event.metaKey)) return;
      event.preventDefault();
      this.root.requestSubmit();
    };
    const how = make("small", { textContent:
      "The answer is what your lines call answer. Shift and Enter run them; print shows here." });
    if (this.way === "code") return make("div", {}, this.code, how);
    this.fold = make("details", { className: "answer-python" },
      make("summary", { textContent: "Compute it in Python" }), this.code, how);
    this.fold.ontoggle = () => {
      this.#follow();
      this.onTyped(this.typed);
    };
    return this.fold;
  }

  #panelButton() {
    const button = make("button", {
      type: "button", className: "answer-check", textContent: "Check the panel as it stands",
    });
    button.onclick = () => {
      if (!this.busy) this.onAnswer({ way: "panel" });
    };
    return button;
  }

  // Who computes answers by the lines, and what is typed above them is put aside.
  #follow() {
    this.button.textContent = this.inPython ? "Run and check" : "Check";
    if (this.simple) this.simple.hidden = this.inPython;
  }
}
