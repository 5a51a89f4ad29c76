// Previews: over a link to a place of this site, or on it with the keyboard, a card shows what
// stands there: an equation, a figure, an entry of the ledger or the reference, a term. A finger
// follows the link instead, and where a page cannot be fetched, as on a disk, no card comes.
"use strict";

(() => {
  const LINKS = "article a[href*='#']:not(.headerlink, .footnote-reference, [role=doc-backlink])";
  const NOT_COPIED = "script, style, button, input, .headerlink, .viewcode-link, .ways";
  const WAIT = 250; // ms before a card comes, and before it goes
  const EDGE = 8; // px to the edge of the window
  const BLOCKS = 3; // of a section
  const root = new URL(document.documentElement.dataset.content_root || "./", location.href);
  const pages = new Map();
  let card, link, timer;

  const pageOf = (url) => url.href.split("#")[0];

  // The page of an address, asked for once; null if it cannot be had.
  function pageAt(url) {
    const address = pageOf(url);
    if (address === pageOf(location)) return document;
    if (url.origin !== location.origin || url.protocol === "file:") return null;
    if (!pages.has(address)) {
      const asked = fetch(address).then((answer) => (answer.ok ? answer.text() : ""));
      const read = asked.then((text) => new DOMParser().parseFromString(text, "text/html"));
      pages.set(address, read.catch(() => pages.delete(address) && null)); // perhaps next time
    }
    return pages.get(address);
  }

  // What a reader would see at a target: of a section its heading and what comes first.
  function partsAt(target) {
    if (target.matches("section")) {
      const shown = [...target.children].filter((part) => !part.matches("span, section"));
      const first = shown.slice(0, BLOCKS + 1);
      return shown.length > 1 ? first : [...first, ...partsOfFirst(target)];
    }
    if (target.matches("dt")) {
      const says = target.parentElement.querySelector(":scope > dd");
      const whole = !target.matches(".sig");
      const first = says && (whole ? says : says.querySelector(":scope > p"));
      return first ? [target, first] : [target];
    }
    if (target.matches("div.cell")) return [target.querySelector(".cell_output") || target];
    if (target.matches("span, a") && !target.textContent.trim()) return partsAfter(target);
    // A caption in bold letters under a picture, as in the gallery.
    const before = target.previousElementSibling;
    if (target.matches("p") && before?.querySelector(":scope > img:only-child")) {
      return [before, target];
    }
    return [target];
  }
  // A name without a thing of its own stands in front of it, or inside.
  function partsAfter(mark) {
    let next = mark.nextElementSibling;
    while (next?.matches("span:empty")) next = next.nextElementSibling;
    const around = mark.parentElement;
    return !next || around.matches("p, li, td, dd, figure") || next.matches("h1, h2, h3, h4, h5")
      ? partsAt(around)
      : partsAt(next);
  }
  const partsOfFirst = (section) =>
    [...section.querySelectorAll(":scope > section")].slice(0, 1).flatMap(partsAt);

  // A copy of them for the card, without what one could press, and without names used twice.
  function copied(parts, address) {
    const copy = document.createElement("div");
    for (const part of parts) copy.append(part.cloneNode(true));
    for (const row of copy.querySelectorAll(":scope > tr")) {
      const table = document.createElement("table");
      row.replaceWith(table);
      table.append(row);
    }
    copy.querySelectorAll(NOT_COPIED).forEach((part) => part.remove());
    for (const part of copy.querySelectorAll("*")) {
      part.removeAttribute("id");
      part.removeAttribute("tabindex");
      if (part.matches("img[src]")) {
        part.src = new URL(part.getAttribute("src"), address).href;
        part.loading = "eager";
      }
      if (part.matches("a")) {
        const words = document.createElement("span");
        words.append(...part.childNodes);
        part.replaceWith(words);
      }
    }
    return copy;
  }

  // Formulas of another page are TeX still. A page without any has no MathJax yet.
  async function setFormulas(copy) {
    if (!copy.querySelector(".math:not(:has(mjx-container))")) return;
    if (!window.MathJax) {
      const only = { ignoreHtmlClass: ".*", processHtmlClass: "math" };
      window.MathJax = { options: only, startup: { typeset: false } };
      const script = document.createElement("script");
      script.src = new URL("_static/mathjax/tex-chtml.js", root);
      const loaded = new Promise((done) => script.addEventListener("load", done));
      document.head.append(script);
      await loaded;
    }
    await window.MathJax.startup?.promise;
    await window.MathJax.typesetPromise?.([copy]);
  }

  // Below the link, or above it where there is more room; never over it.
  function place() {
    const [line] = link.getClientRects();
    const width = document.documentElement.clientWidth;
    const below = window.innerHeight - line.bottom - EDGE;
    const above = line.top - EDGE;
    const up = below < card.scrollHeight + EDGE && above > below;
    card.style.maxHeight = `${Math.max(0, (up ? above : below) - EDGE)}px`;
    const left = Math.min(Math.max(EDGE, line.left), width - EDGE - card.offsetWidth);
    const top = up ? line.top - 4 - card.offsetHeight : line.bottom + 4;
    card.style.left = `${left + window.scrollX}px`;
    card.style.top = `${top + window.scrollY}px`;
  }

  async function show(wanted) {
    hide();
    const url = new URL(wanted.href);
    link = wanted;
    const page = await pageAt(url);
    const target = page?.getElementById(decodeURIComponent(url.hash.slice(1)));
    if (!target || link !== wanted) return;
    const made = document.createElement("div");
    made.className = "preview";
    made.id = "preview";
    made.setAttribute("role", "tooltip");
    made.append(copied(partsAt(target), pageOf(url)));
    card?.remove();
    card = made;
    document.body.append(made);
    wanted.dataset.title = wanted.title; // or the browser's own card would come over this one
    wanted.removeAttribute("title");
    wanted.setAttribute("aria-describedby", "preview");
    place();
    made.addEventListener("pointerenter", () => clearTimeout(timer));
    made.addEventListener("pointerleave", leave);
    await setFormulas(made);
    const seen = [...made.querySelectorAll("img")].map((image) => image.decode().catch(() => {}));
    await Promise.all(seen);
    if (card === made) {
      place();
      made.dataset.ready = "";
    }
  }

  function hide() {
    clearTimeout(timer);
    card?.remove();
    if (link?.dataset.title) link.title = link.dataset.title;
    link?.removeAttribute("aria-describedby");
    card = link = undefined;
  }

  function come(event) {
    const wanted = event.target.closest?.(LINKS);
    if (!wanted || wanted.closest(".preview")) return;
    clearTimeout(timer);
    if (wanted !== link) timer = setTimeout(() => show(wanted), WAIT);
  }
  function leave() {
    clearTimeout(timer);
    timer = setTimeout(hide, WAIT);
  }

  const on = (name, does) => document.addEventListener(name, does);
  on("pointerover", (event) => event.pointerType === "mouse" && come(event));
  on("pointerout", (event) => event.target.closest?.(LINKS) && leave());
  on("focusin", (event) => event.target.matches(":focus-visible") && come(event));
  on("focusout", leave);
  on("keydown", (event) => event.key === "Escape" && hide());
  on("click", hide);
  window.addEventListener("resize", hide);
})();
