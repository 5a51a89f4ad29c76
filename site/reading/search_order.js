/* What the search puts first: words of the glossary, tasks, and chapters by
   their headings; then functions; then what only has the word somewhere in its text. */
const BY_HEADING = /^(\d\d_|i_want_to)/; // pages to read
var Scorer = {
  score: (result) => {
    const [docname, , anchor, , score, , kind] = result;
    if (kind === "title" && BY_HEADING.test(docname)) return score + 100;
    if (kind !== "index" || !anchor) return score;
    // An entry of the index knows its page and its place only: here it says which function, term or
    // task.
    const place = anchor.slice(1);
    if (place.startsWith("driftlab.")) {
      result[1] = place;
      return score;
    }
    if (place.startsWith("term-")) {
      result[1] = `Glossary: ${place.slice("term-".length).replaceAll("-", " ")}`;
      return score + 100;
    }
    const titles = Object.entries(Search._index.alltitles);
    const task = titles.find(([, places]) => places.some(([, id]) => id === place));
    if (task) result[1] = task[0];
    return score + 1;
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 0, 1: 15, 2: -5 }, // modules; functions, classes and constants; what is else
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};

// From a disk no page can be asked for the lines around a word; the titles are found all the same.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
