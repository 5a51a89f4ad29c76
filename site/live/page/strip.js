// The strip above the notebook: what Python is doing, what this browser cannot do, where one's work
// is kept; and links of the chapters that lead to pages of the site.
import { behind, texts } from "./copies.js";

const about = document.documentElement.dataset; // version, megabytes, probe: written by lite.py
const STARTING = `Python is starting. The first time it fetches some ${about.megabytes} MB, a minute or more on a slow line; from then on it takes some seconds.`;
const READY = `Python is ready. What you change is kept in this browser, for version ${about.version} of the book.`;
const READ_ON = "The chapter can still be read, here and on its page.";
const CHANGED = "The book's text of this notebook has changed since you began with it. What is yours stays; rename it in the list of files, and the new one opens.";

const site = new URL("../../", document.baseURI);
const strip = document.createElement("header");
const says = document.createElement("p");
says.setAttribute("role", "status");
const page = document.createElement("a");
leadToPageOf(opened());
strip.append(page, says, link("My work", new URL("../my-work.html", document.baseURI)));
strip.id = "strip";
document.body.prepend(strip);
new ResizeObserver(() => {
  document.body.style.setProperty("--strip", `${strip.offsetHeight}px`);
  dispatchEvent(new Event("resize")); // JupyterLab measures the rest anew
}).observe(strip);

// Chapters link to "#site/errata.html" for what stands on the site only.
addEventListener("click", (event) => {
  const target = event.target.closest?.('a[href*="#site/"]')?.getAttribute("href");
  if (target) {
    event.preventDefault();
    event.stopPropagation();
    const url = new URL(target.split("#site/")[1], site);
    if (url.origin === site.origin) open(url, "_blank", "noopener"); // a notebook may be anyone's
  }
}, { capture: true });

const troubles = await whatIsMissing();
say(...(troubles.length ? [...troubles, READ_ON] : [STARTING]), ...newsOf(opened()));
if (!troubles.some((trouble) => trouble.startsWith("Python"))) follow(await application());

// The notebook that the link to this page names, whoever wrote the link.
function opened() {
  return new URLSearchParams(location.search).get("path") ?? "";
}

// A copy of a chapter, whatever a reader has put behind its name, has the chapter's page.
function leadToPageOf(path) {
  const names = Object.keys(texts).map((name) => name.slice(0, -".ipynb".length));
  const chapter = names.filter((name) => path.startsWith(name)).sort().at(-1); // the longest
  page.textContent = chapter ? "Chapter's page" : "The book's pages";
  page.href = new URL(`${chapter ?? "index"}.html`, site);
}

function newsOf(path) {
  return behind.has(path) ? [CHANGED] : [];
}

function link(text, target) {
  return Object.assign(document.createElement("a"), { textContent: text, href: target });
}

function say(...sentences) {
  says.textContent = sentences.join(" ");
}

async function whatIsMissing() {
  const found = [];
  if (typeof WebAssembly !== "object" || typeof Worker !== "function") {
    found.push("Python cannot run: this browser has no WebAssembly, or it is switched off.");
  } else if (about.probe && !(await fetch(about.probe).catch(() => false))) {
    found.push(`Python cannot start: its packages come from ${new URL(about.probe).host}, which cannot be reached from here.`);
  }
  if (!(await mayKeep())) {
    found.push("This browser keeps nothing for the page: what you write is gone when you close it, so download it before (File, Download).");
  }
  return found;
}

function mayKeep() {
  return new Promise((answer) => {
    const name = "Drift Lab: may it be kept?";
    try {
      const request = indexedDB.open(name);
      request.onerror = () => answer(false);
      request.onsuccess = () => {
        request.result.close();
        indexedDB.deleteDatabase(name);
        answer(true);
      };
    } catch {
      answer(false);
    }
  });
}

function application() {
  return new Promise((resolve) => {
    const look = setInterval(() => {
      if (window.jupyterapp) {
        clearInterval(look);
        resolve(window.jupyterapp);
      }
    }, 100);
  });
}

async function follow(app) {
  await app.restored;
  fold(app.shell);
  const look = async () => {
    const shown = app.shell.currentWidget?.context;
    const session = app.shell.currentWidget?.sessionContext;
    if (!session) return;
    const path = shown?.path ?? ""; // a console has none
    leadToPageOf(path);
    say(...troubles, STARTING, ...newsOf(path));
    await session.ready;
    await session.session?.kernel?.info;
    if (app.shell.currentWidget?.sessionContext === session) {
      const ready = troubles.length ? ["Python is ready.", ...troubles] : [READY];
      say(...ready, ...newsOf(path));
    }
  };
  app.shell.currentChanged.connect(look);
  look();
}

// JupyterLab opens its list of files by itself, and late: until the reader does something, it stays
// folded.
function fold(shell) {
  const close = () => {
    if (!shell.leftCollapsed) shell.collapseLeft();
  };
  shell.layoutModified.connect(close);
  close();
  for (const event of ["pointerdown", "keydown"]) {
    addEventListener(event, () => shell.layoutModified.disconnect(close), { capture: true, once: true });
  }
}
