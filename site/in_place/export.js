// A reader's answers as a notebook: it runs in Jupyter, and whoever marks a class reads and counts
// it like the chapters that students hand in (`driftlab.book.class_summary`).
export function notebook(answers, version) {
  const today = new Date().toISOString().slice(0, 10);
  const about = `Exercises of Drift Lab ${version}, answered on its pages. ${today}`;
  const cells = [text("about", `# My answers\n\n${about}`)];
  for (const [number, { cell, says }] of answers) {
    cells.push(text(`text-${number}`, `## ${number}`), {
      id: cellId(`code-${number}`), cell_type: "code", execution_count: null, metadata: {},
      source: cell,
      outputs: [{ output_type: "stream", name: "stdout", text: `${says}\n` }],
    });
  }
  return { nbformat: 4, nbformat_minor: 5, metadata: {
    kernelspec: { display_name: "Python 3", language: "python", name: "python3" },
  }, cells };
}

export function downloadAnswers(answers, version) {
  const made = new Blob([JSON.stringify(notebook(answers, version), null, 1)],
    { type: "application/x-ipynb+json" });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(made);
  link.download = "drift-lab-answers.ipynb";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function text(id, source) {
  return { id: cellId(id), cell_type: "markdown", metadata: {}, source };
}

function cellId(name) {
  return name.replaceAll(".", "-");
}
