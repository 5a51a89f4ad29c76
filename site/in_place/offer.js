// What begin.js loads in a current browser, a classic script like it, which works from a file too. A
// panel or scene has a button, whose first click fetches the modules and Python; the forms of
// exercises and guesses come at once, and Python when it is asked something. Whatever is in the way
// is one sentence.

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

  const SIGNS = ["wheel", "pointerdown", "keydown"]; // that a reader goes where he wants

  const make = (kind, properties, ...inside) => {
    const element = Object.assign(document.createElement(kind), properties);
    element.append(...inside);
    return element;
  };

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
    const start = async (link) => {
      button.disabled = true;
      note.textContent = "";
      try {
        const panels = await fetchModule("panels.js");
        await panels.begin(figure, offered, link);
      } catch (error) {
        refuse(note, error);
      }
      button.disabled = false;
    };
    button.addEventListener("click", () => start());
    const caption = figure.querySelector("figcaption");
    if (caption) caption.textContent = "This is how it stood when the chapter was run.";
    figure.append(offered);
    return { figure, start };
  }

  // Formulas, pictures and the panel itself move what was in view; it is brought back until the
  // reader does something.
  function keepInView(element) {
    const bring = () => element.scrollIntoView({ behavior: "instant" });
    const article = new ResizeObserver(bring); // the page itself is as high as the screen
    const leave = () => {
      article.disconnect();
      for (const sign of SIGNS) removeEventListener(sign, leave, true);
    };
    for (const sign of SIGNS) addEventListener(sign, leave, { capture: true, passive: true });
    article.observe(element.closest("article") ?? document.body);
    bring();
  }

  // A link that someone shared names a panel and its values. Who follows it wants to see just that,
  // so the panel starts without a click, unless the browser is told to save data.
  function follow(offers) {
    const link = new URLSearchParams(location.hash.slice(1));
    const [name, number = "1"] = (link.get("panel") ?? "").split(".");
    const named = offers.filter(({ figure }) => figure.dataset.panel === name)[number - 1];
    if (!named) return;
    for (let fold = named.figure; (fold = fold.parentElement.closest("details")); ) fold.open = true;
    keepInView(named.figure);
    link.delete("panel");
    const values = Object.fromEntries(link);
    if (navigator.connection?.saveData) named.figure.dataset.link = JSON.stringify(values);
    else named.start(values);
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

  // Of an address that was cut or mistyped, as "#%", nothing; the forms come all the same.
  function placeAskedFor() {
    try {
      return decodeURIComponent(location.hash.slice(1));
    } catch {
      return "";
    }
  }

  function begin() {
    const offers = [...document.querySelectorAll(PANELS)].map(offer);
    const place = document.getElementById(placeAskedFor());
    if (place) keepInView(place);
    follow(offers);
    window.addEventListener("hashchange", () => follow(offers));
    for (const [selector, name] of FORMS) fill(selector, name);
  }

  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", begin);
  else begin();
})();
