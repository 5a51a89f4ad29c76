// The strip above the notebook: what Python is doing, where one's work is kept, and the way to the
// book's pages, to which links of the chapters lead, too.

const about = document.documentElement.dataset; // megabytes, probe: written by lite.py
const STARTING = `Python is starting. The first time it fetches some ${about.megabytes} MB, a minute or more on a slow line; from then on it takes some seconds.`;
const READY = "Python is ready. What you change is kept in this browser; to see the book's own text of a notebook again, delete your copy in the list of files.";
const READ_ON = "The chapter can still be read, here and on its page.";
const CHAPTER = /^(solutions\/)?\d\d_\w+/; // whatever a reader has put behind the name of a copy

const site = new URL("../../", document.baseURI);
const strip = document.createElement("header");
const says = document.createElement("p");
says.setAttribute("role", "status");
const page = document.createElement("a");
leadToPageOf(new URLSearchParams(location.search).get("path") ?? "");
strip.append(page, says);
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

const trouble = await whatIsMissing();
says.textContent = trouble ? `${trouble} ${READ_ON}` : STARTING;
const look = setInterval(() => {
  if (!window.jupyterapp) return;
  clearInterval(look);
  follow(window.jupyterapp);
}, 100);

function leadToPageOf(path) {
  const chapter = CHAPTER.exec(path)?.[0];
  page.textContent = chapter ? "Chapter's page" : "The book's pages";
  page.href = new URL(`${chapter ?? "index"}.html`, site);
}

async function whatIsMissing() {
  if (typeof WebAssembly !== "object" || typeof Worker !== "function") {
    return "Python cannot run: this browser has no WebAssembly, or it is switched off.";
  }
  if (!about.probe || (await fetch(about.probe).catch(() => false))) return "";
  return `Python cannot start: its packages come from ${new URL(about.probe).host}, which cannot be reached from here.`;
}

async function follow(app) {
  await app.restored;
  fold(app.shell);
  const look = async () => {
    const session = app.shell.currentWidget?.sessionContext;
    if (!session || trouble) return;
    leadToPageOf(app.shell.currentWidget.context?.path ?? ""); // a console has none
    says.textContent = STARTING;
    await session.ready;
    await session.session?.kernel?.info;
    if (app.shell.currentWidget?.sessionContext === session) says.textContent = READY;
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
