// A reader's answers as a notebook: it runs in Jupyter, and whoever marks a class reads and counts
// it like the chapters that students hand in (`python3 lab.py class`).

const RECORD = "application/vnd.driftlab.exercise+json"; // as machinery/exercise/records.py has it

const LONGEST = 50; // signs of a name; file systems take 255 bytes, and a sign may have four

// A name that every file system takes: small letters and digits, whatever the alphabet.
export function fileName(name) {
  const plain = name.normalize("NFD").replace(/(\p{Script=Latin})\p{M}+/gu, "$1").normalize("NFC");
  const words = [...plain.toLowerCase()].slice(0, LONGEST).join("").match(/[\p{L}\p{M}\p{N}]+/gu);
  return `${["drift-lab-answers", ...(words ?? [])].join("-")}.ipynb`;
}

export function notebook(answers, name, version) {
  const chapters = new Map();
  for (const [number, answer] of answers) {
    const chapter = number.split(".")[0].padStart(2, "0");
    chapters.set(chapter, [...(chapters.get(chapter) ?? []), [number, answer]]);
  }
  const title = name ? `# Answers of ${plainText(name)}` : "# My answers";
  const which = `${chapters.size > 1 ? "chapters" : "chapter"} ${[...chapters.keys()].join(", ")}`;
  const about =
    `Exercises of Drift Lab ${version}, ${which}, answered on the book's pages; exported ${today()}.`;
  const cells = [text("about", `${title}\n\n${about}`)];
  for (const [chapter, each] of chapters) {
    cells.push(text(`chapter-${chapter}`, `## Chapter ${chapter}`));
    for (const [number, { cell, says, record }] of each)
      cells.push(text(`text-${number}`, `### ${number}`), {
        id: cellId(`code-${number}`), cell_type: "code", execution_count: null, metadata: {},
        source: cell,
        outputs: [{
          output_type: "display_data", metadata: {},
          data: { "text/plain": says, ...(record && { [RECORD]: record }) },
        }],
      });
  }
  return { nbformat: 4, nbformat_minor: 5, metadata: {
    kernelspec: { display_name: "Python 3", language: "python", name: "python3" },
  }, cells };
}

// The reader's own day, written as 2026-01-31: so Swedes write it.
function today() {
  return new Date().toLocaleDateString("sv-SE");
}

function plainText(name) {
  return name.replace(/[!-&(-+/:-@[-`{-~]/g, "\\$&"); // only these mean something in Markdown
}

function text(id, source) {
  return { id: cellId(id), cell_type: "markdown", metadata: {}, source };
}

function cellId(name) {
  return name.replaceAll(".", "-");
}
