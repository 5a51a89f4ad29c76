/* Divides what a chapter has for a slide into as many slides as it needs, below each other, then
   starts reveal.js. It measures after formulas and pictures are there, with the fonts of this very
   computer; so what is here fits, whoever shows it. */
(async () => {
  const CANVAS = { width: 1200, height: 675 };
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
  }
  measure.remove();
  await Promise.all([...cells.querySelectorAll("img")].map((img) => img.decode()));
  cells.removeAttribute("id");
  await Reveal.initialize({
    ...CANVAS, margin: 0.01, center: false, hash: true, slideNumber: "c/t",
    transition: "none", backgroundTransition: "none", plugins: [RevealNotes],
  });
  document.documentElement.dataset.ready = "yes";

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
    if (element.offsetHeight < HEIGHT - 90 && !element.matches("ul, ol")) return [block];
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
      from = best[end].from;
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
      sized(img, img.offsetHeight + Math.max(0, HEIGHT - own.offsetHeight + 24));
    }
    made.prepend(own);
  }
})();
