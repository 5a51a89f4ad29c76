// What a reader has answered and guessed, and the name to export it under: kept in the browser,
// by the version of the book, whose next one may ask something else. Where nothing may be kept, it
// lasts as long as the page.
export const BLOCKED =
  "This browser does not let the page keep anything: what you answer lasts until you leave it.";

const isPlain = (value) => Object.prototype.toString.call(value) === "[object Object]";
// What an entry must look like. Whatever else stands there, from elsewhere or by hand, counts as
// none: it must not take the forms away.
const SOUND = {
  exercises: isPlain,
  guesses: (entry) => entry === null || Array.isArray(entry),
  reader: (entry) => typeof entry === "string",
};

export class Kept {
  #memory = {};

  constructor(version) {
    this.name = `Drift Lab ${version}: answers`;
    this.blocked = false;
    this.all();
  }

  // Read each time, since another tab may have answered meanwhile.
  all() {
    let text;
    try {
      text = this.blocked ? null : localStorage.getItem(this.name);
    } catch {
      this.blocked = true;
    }
    try {
      const kept = text ? JSON.parse(text) : null;
      if (isPlain(kept)) this.#memory = kept;
    } catch {
      // Not written by this page; the next answer takes its place.
    }
    return this.#memory;
  }

  of(kind) {
    const found = this.all()[kind];
    const entries = Object.entries(isPlain(found) ? found : {});
    return Object.fromEntries(entries.filter(([, entry]) => SOUND[kind](entry)));
  }

  put(kind, key, value) {
    this.#memory = { ...this.all(), [kind]: { ...this.of(kind), [key]: value } };
    try {
      localStorage.setItem(this.name, JSON.stringify(this.#memory));
    } catch {
      this.blocked = true;
    }
  }
}
