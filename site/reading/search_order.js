/* How the search orders what it found: words of the field first, then functions, then modules. */
var Scorer = {
  score: (result) => {
    const anchor = result[2], score = result[4], kind = result[6];
    if (kind !== "index" || !anchor) return score;
    // An entry of the index knows its page and its place only: here it says which function, term or
    // task.
    const place = anchor.slice(1);
    if (place.startsWith("driftlab.")) {
      result[1] = place;
      return score + 1;
    }
    if (place.startsWith("term-")) {
      result[1] = `Glossary: ${place.slice("term-".length).replaceAll("-", " ")}`;
      return score;
    }
    const titles = Object.entries(Search._index.alltitles);
    const task = titles.find(([, places]) => places.some(([, id]) => id === place));
    if (task) result[1] = task[0];
    return score;
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
