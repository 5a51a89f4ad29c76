/* Divides what a chapter has for a slide into as many slides as it needs, below each other, then
   starts reveal.js. It measures after formulas and pictures are there, with the fonts of this very
   computer; so what is here fits, whoever shows it. A slide has the shape of the window it was
   opened in, from 16:9 to 4:3, and is filled to where the number of the slide stands. The frames of
   the speaker view have other shapes, and may lie on another screen; so their address says how high
   a slide is, and how this window divided the chapter, decision by decision. */
(async () => {
  const told = new URLSearchParams(location.search);
  const decisions = told.get("divided")?.split("-").map(Number);
  const taken = []; // decisions, in their order
  const ownHeight = Math.round(Math.min(900, Math.max(675, (1200 * innerHeight) / innerWidth)));
  const CANVAS = { width: 1200, height: Number(told.get("height")) || ownHeight };
  const [WIDTH, HEIGHT, LEAST] = [CANVAS.width - 60, CANVAS.height - 64, 18];
  let counted = 0; // lists and tables that were taken apart
  const HEADINGS = "h1, h2, h3, h4";
  const cells = document.getElementById("cells");
  const measure = document.body.appendChild(document.createElement("div"));
  measure.id = "measure";

  await MathJax.startup.promise;
  await document.fonts?.ready;
  const sheet = measure.appendChild(document.createElement("div"));
  sheet.className = "sheet";

  for (const row of [...cells.children]) {
    for (const section of [...row.children]) section.replaceWith(...(await divided(section)));
    if (!row.children.length) row.remove();
    else if (isOneLine(row.previousElementSibling)) joinedTo(row, row.previousElementSibling);
  }
  measure.remove();
  await Promise.all([...cells.querySelectorAll("img")].map((img) => img.decode()));
  cells.removeAttribute("id");
  const division = { height: `${CANVAS.height}`, divided: taken.join("-") };
  const url = `${location.protocol}//${location.host}${location.pathname}?${new URLSearchParams(division)}`;
  addEventListener("message", told.has("receiver") ? followed : followers);
  await Reveal.initialize({
    ...CANVAS, margin: 0.01, center: false, hash: true, slideNumber: "c/t", url,
    transition: "none", backgroundTransition: "none", plugins: [RevealNotes],
  });
  document.documentElement.dataset.ready = "yes";

  /* The speaker view says each second that it is there; if this window was opened anew, by F5, its
     frames still have what was before. */
  function followers({ data, source }) {
    if (!/"heartbeat"/.test(data)) return;
    for (let frame = 0; frame < source.length; frame += 1) source[frame].postMessage(division, "*");
  }
  function followed({ data }) {
    if (!data?.divided || Object.keys(division).every((key) => data[key] === told.get(key))) return;
    const address = new URL(location);
    for (const key of Object.keys(division)) address.searchParams.set(key, data[key]);
    location.replace(address);
  }

  /* What was measured; in the speaker view, what the other window has measured. */
  function decided(value) {
    taken.push(decisions ? decisions[taken.length] : value);
    return taken.at(-1);
  }

  async function divided(section) {
    let blocks = flat(section);
    sheet.replaceChildren(...blocks.map((block) => block.element));
    await MathJax.typesetPromise([sheet]);
    await Promise.all([...sheet.querySelectorAll("img")].map((img) => img.decode()));
    sheet.querySelectorAll("img").forEach((img) => sized(img, 0.66 * HEIGHT));
    for (const { element } of blocks) {
      const img = element.querySelector("img"), over = element.offsetHeight + 60 - HEIGHT;
      if (img && over > 0) sized(img, img.offsetHeight - over); // its caption is long
      narrowed(element);
    }
    if (blocks.every(({ element }) => element.matches(HEADINGS))) return [];
    blocks = blocks.flatMap(pieces);
    return gathered(blocks);
  }

  /* The blocks of a slide in their order. Those with the same step come at one key press. */
  function flat(section) {
    const blocks = [];
    const add = (element, step) => {
      if (!element.matches("aside.notes")) blocks.push({ element, step, notes: [] });
      else blocks.at(-1)?.notes.push(element);
    };
    for (const child of section.children) {
      if (child.matches(".fragment")) for (const part of child.children) add(part, child);
      else add(child, null);
    }
    return blocks;
  }

  function sized(img, highest) {
    const ratio = img.naturalWidth / img.naturalHeight;
    const height = Math.min(highest, WIDTH / ratio);
    img.style.height = `${height}px`;
    img.style.width = `${height * ratio}px`;
  }

  /* Makes type smaller where a formula, a table or what was printed is too wide, to the least. */
  function narrowed(element) {
    const wide = () => Math.max(element.scrollWidth / element.clientWidth,
      ...[...element.querySelectorAll("mjx-container, table")].map(
        (part) => part.getBoundingClientRect().width / element.clientWidth));
    const target = element.querySelector(":scope > table") ?? element;
    for (let step = 0; step < 4 && wide() > 1.001; step += 1) {
      const now = parseFloat(getComputedStyle(target).fontSize);
      target.style.fontSize = `${Math.max(LEAST, Math.floor((2 * now) / wide()) / 2)}px`;
    }
  }

  /* A list, table or print that is higher than a slide, part by part. */
  function pieces(block) {
    const { element } = block;
    const whole = element.matches("table") ? element : element.querySelector(":scope > table");
    const parts = element.matches("ul, ol") ? [...element.children]
      : whole ? [...whole.querySelectorAll("tbody > tr")] : [];
    if (parts.length < 2) return [block];
    const fits = element.offsetHeight < HEIGHT - 90 && !element.matches("ul, ol");
    if (decided(fits ? 1 : 0)) return [block];
    counted += 1;
    const found = parts.map((part, number) => {
      const own = whole ? element.cloneNode(true) : element.cloneNode(false);
      if (whole) own.querySelector("tbody").replaceChildren(part.cloneNode(true));
      else own.append(part.cloneNode(true));
      if (element.matches("ol")) own.start = (element.start || 1) + number;
      own.dataset.of = counted;
      return { element: own, step: block.step, notes: number ? [] : block.notes, of: counted };
    });
    element.replaceWith(...found.map((each) => each.element));
    return found;
  }

  /* Sections, each with what fits: as few as can be, then filled as evenly as can be. */
  function gathered(blocks) {
    sheet.replaceChildren(...blocks.map((block) => block.element));
    const top = blocks.map((block) => block.element.offsetTop);
    const bottom = blocks.map((block) => block.element.offsetTop + block.element.offsetHeight);
    const best = [{ cost: 0, from: 0 }];
    for (let end = 1; end <= blocks.length; end += 1) {
      best[end] = { cost: Infinity, from: end - 1 };
      for (let from = end - 1; from >= 0; from -= 1) {
        const high = bottom[end - 1] - top[from] + (from ? 48 : 0);
        if (high > HEIGHT && from < end - 1) break;
        const free = Math.max(0, HEIGHT - high) / HEIGHT;
        const cost = best[from].cost + 10 + free * free + parted(blocks, end);
        if (cost < best[end].cost) best[end] = { cost, from };
      }
    }
    const pages = [];
    for (let end = blocks.length, from; end > 0; end = from) {
      from = decided(best[end].from);
      pages.unshift(blocks.slice(from, end));
    }
    const heading = blocks[0]?.element;
    return pages.map((page, number) => section(page, number ? heading : null));
  }

  /* How ill it is to turn the page here: after a heading, a colon, or code before its output. */
  function parted(blocks, end) {
    if (end === blocks.length) return 0;
    const [last, next] = [blocks[end - 1].element, blocks[end].element];
    if (last.matches(HEADINGS)) return 1000;
    if (last.matches(".code") && next.matches("pre, .shown, .formula")) return 3;
    if (last.matches("p") && /:\s*$/.test(last.textContent)) return 3;
    return blocks[end].of && blocks[end].of === blocks[end - 1].of ? 1 : 0;
  }

  function section(page, heading) {
    const made = document.createElement("section");
    const own = made.appendChild(document.createElement("div"));
    own.className = "sheet";
    if (heading?.matches(HEADINGS)) {
      const again = own.appendChild(document.createElement("p"));
      again.className = "again";
      again.innerHTML = heading.innerHTML;
    }
    const first = page.find((block) => !block.element.matches(HEADINGS));
    let place = own, step = null;
    for (const block of page) {
      // What a new slide begins with has had its key press.
      const own_step = heading && block.step === first?.step ? null : block.step;
      if (own_step !== step) {
        place = own_step ? own.appendChild(document.createElement("div")) : own;
        if (own_step) place.className = "fragment";
        step = own_step;
      }
      place.append(block.element);
      made.append(...block.notes);
    }
    joined(own);
    grown(own, made);
    return made;
  }

  /* A row that is nothing but a heading and a paragraph, as where the rest is folded in the book. */
  function isOneLine(row) {
    const parts = row?.querySelectorAll(".sheet > *") ?? [];
    return parts.length === 2 && parts[0].matches("h2") && parts[1].matches("p");
  }

  /* It stands above what comes next, if there is room. */
  function joinedTo(row, before) {
    const [lone, next] = [before, row].map((each) => each.querySelector(".sheet"));
    const made = next.parentElement;
    const count = lone.children.length;
    next.prepend(...lone.children);
    measure.append(next);
    const fits = decided(next.offsetHeight <= HEIGHT + 24 ? 1 : 0);
    made.prepend(next);
    if (!fits) lone.append(...[...next.children].slice(0, count));
    else {
      made.append(...before.querySelectorAll("aside.notes"));
      before.remove();
    }
  }

  /* Parts of one list or table that came onto one slide are one again. */
  function joined(own) {
    for (const part of [...own.querySelectorAll(".sheet > *, .fragment > *")]) {
      const before = part.previousElementSibling;
      if (before && before.dataset.of && before.dataset.of === part.dataset.of) {
        (before.querySelector("tbody") ?? before).append(
          ...(part.querySelector("tbody") ?? part).children);
        part.remove();
      }
    }
  }

  /* A picture that is alone on its slide takes the room that is left. */
  function grown(own, made) {
    const pictures = own.querySelectorAll("img");
    measure.append(own);
    if (pictures.length === 1) {
      const [img] = pictures;
      const height = img.offsetHeight + Math.max(0, HEIGHT - own.offsetHeight + 24);
      if (!stacked(img, height)) sized(img, height);
    }
    made.prepend(own);
  }

  /* A scene of two views with its plot beside them is as wide as the slide before it is high. Where
     that leaves room, the plot comes below the views, as large as it was, and they get larger. */
  function stacked(img, height) {
    const [head, data] = img.src.split(",");
    if (head !== "data:image/svg+xml;base64" || height < 1.2 * img.offsetHeight) return false;
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    const scene = new DOMParser().parseFromString(new TextDecoder().decode(bytes), "image/svg+xml");
    const root = scene.documentElement, parts = [...root.children];
    const views = parts.filter((part) => part.matches("svg:not(.dl-plot)"));
    const plots = parts.filter((part) => part.matches(".dl-plot"));
    if (!root.matches(".dl-scene") || views.length !== 2 || plots.length !== 1) return false;

    const number = (part, name) => Number(part.getAttribute(name));
    const [wide, high] = ["width", "height"].map((name) => number(root, name));
    const left = number(plots[0], "x"), down = number(plots[0], "height") + 10;
    const was = img.offsetWidth / wide;
    const scale = Math.min(WIDTH / left, (height - down * was) / high);
    if (scale < 1.08 * was) return false;
    const beside = parts.filter((part) => number(part, "x") >= left);
    for (const text of beside.filter((part) => part.matches("text"))) {
      text.setAttribute("x", number(text, "x") + number(plots[0], "width"));
      text.setAttribute("y", number(text, "y") - down);
    }
    const group = (members, x, y, by) => {
      const made = scene.createElementNS(root.namespaceURI, "g");
      made.setAttribute("transform", `translate(${x} ${y}) scale(${by})`);
      made.append(...members);
      return made;
    };
    const total = scale * high + was * down, margin = (WIDTH - scale * left) / 2;
    const paper = parts.find((part) => part.matches("rect"));
    const above = parts.filter((part) => /^(svg|text)$/.test(part.tagName) && !beside.includes(part));
    root.append(group(above, margin, 0, scale), group(beside, margin - was * left, scale * high, was));
    for (const part of [root, paper]) {
      part.setAttribute("width", WIDTH);
      part.setAttribute("height", total);
    }
    root.setAttribute("viewBox", `0 0 ${WIDTH} ${total}`);
    img.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(scene))}`;
    [img.style.width, img.style.height] = [`${WIDTH}px`, `${total}px`];
    return true;
  }
})();
