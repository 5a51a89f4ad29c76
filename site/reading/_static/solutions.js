/* Worked solutions: when a reader unfolds one, it comes from its page into the chapter's. Where a
   page may not read another, as on a disk, the link to that page is what the fold has. */

async function bring(fold) {
  const link = fold.querySelector("a");
  const answer = await fetch(link.href);
  if (!answer.ok) return;
  const page = new DOMParser().parseFromString(await answer.text(), "text/html");
  const solution = page.getElementById(link.hash.slice(1));
  if (!solution) return;
  const [heading, back, ...content] = [...solution.children].filter((part) => part.tagName !== "SPAN");
  const place = document.createElement("div");
  place.append(...content);
  for (const name of ["href", "src"]) {
    for (const part of place.querySelectorAll(`[${name}]`)) {
      part.setAttribute(name, new URL(part.getAttribute(name), link.href).href);
    }
  }
  for (const part of place.querySelectorAll("[id]")) part.removeAttribute("id");
  link.parentElement.before(place);
  window.MathJax?.typesetPromise?.([place]);
}

if (location.protocol !== "file:") {
  for (const fold of document.querySelectorAll("details.solution")) {
    fold.addEventListener("toggle", () => bring(fold).catch(() => {}), { once: true });
  }
}
