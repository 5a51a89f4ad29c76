// What a reader has answered and guessed: kept in the browser, under a name with the version of
// the book, whose next one may ask something else. Where nothing may be kept, it lasts as long as
// the page.
export const BLOCKED =
  "This browser does not let the page keep anything: what you answer lasts until you leave it.";

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
      this.#memory = text ? JSON.parse(text) : this.#memory;
    } catch {
      // Not written by this page; the next answer takes its place.
    }
    return this.#memory;
  }

  of(kind) {
    return this.all()[kind] ?? {};
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
