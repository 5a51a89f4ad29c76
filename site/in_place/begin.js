// What every page loads, a classic script that works from a file too. A panel or scene has a button,
// whose first click fetches the modules and Python; the forms of exercises and guesses come at once,
// and Python when it is asked something. Whatever is in the way is one sentence.

(() => {
  const HERE = new URL(".", document.currentScript.src).href;
  const PANELS = "figure.driftlab-still[data-panel]";
  const FORMS = [
    ["div.exercise[data-exercise]", "exercises.js"],
    ["div.guess[data-guess]", "guesses.js"],
  ];
  const FROM_FILE =
    "What lives in the page needs a web server, and this page was opened as a file. In the " +
    "site's folder, say ";
  const COMMAND = "python3 -m http.server";
  const NOT_FETCHED =
    "What lives in the page could not be fetched; is the network away? The text and the pictures " +
    "need nothing of it.";

  const make = (kind, properties, ...inside) => {
    const element = Object.assign(document.createElement(kind), properties);
    element.append(...inside);
    return element;
  };

  document.head.append(make("link", { rel: "stylesheet", href: `${HERE}in_place.css` }));

  const fromFile = location.protocol === "file:";
  const fetchModule = (name) =>
    fromFile
      ? Promise.reject(new Error(FROM_FILE))
      : import(HERE + name).catch((error) => {
          console.info(error);
          throw new Error(NOT_FETCHED);
        });

  const refuse = (note, error) => {
    note.textContent = error.message;
    if (error.message === FROM_FILE) {
      note.append(make("code", {}, COMMAND), " and open the address that it names.");
    }
  };

  // A button below the still. The panel in its place takes it away, and Stop brings it back.
  function offer(figure) {
    const button = make("button", { type: "button", className: "in-place-begin" }, "Move it here");
    const note = make("p", { className: "in-place-note" });
    note.setAttribute("role", "status");
    const offered = make("div", { className: "in-place-offer" }, button, note);
    button.addEventListener("click", async () => {
      button.disabled = true;
      note.textContent = "";
      try {
        const panels = await fetchModule("panels.js");
        await panels.begin(figure, offered);
      } catch (error) {
        refuse(note, error);
      }
      button.disabled = false;
    });
    figure.append(offered);
  }

  async function fill(selector, name) {
    const first = document.querySelector(selector);
    if (!first) return;
    try {
      await (await fetchModule(name)).begin();
    } catch (error) {
      const note = make("p", { className: "in-place-note" });
      refuse(note, error);
      first.append(note);
    }
  }

  function begin() {
    document.querySelectorAll(PANELS).forEach(offer);
    for (const [selector, name] of FORMS) fill(selector, name);
  }

  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", begin);
  else begin();
})();
