// What every page loads, a classic script that works from a file too. It is written in the JavaScript
// of 2009, so that an old browser reads it and can be told that it is old; the rest, from offer.js on,
// is for current ones.

(function () {
  "use strict";
  var here = document.querySelector('script[src*="in_place/begin.js"]').src.replace(/[^\/]*$/, "");
  // Where something would come alive, as offer.js has it.
  var PLACES = [
    "figure.driftlab-still[data-panel]", "div.exercise[data-exercise]", "div.guess[data-guess]"
  ];
  var TOO_OLD =
    "What lives in the page needs a newer browser: a current Firefox, Chrome, Edge or Safari will " +
    "do. The text and the pictures need nothing of it.";
  var NOT_THERE =
    "What lives in the page could not be fetched; is the network away? The text and the pictures " +
    "need nothing of it.";

  function isCurrent() {
    try { // each of these stands in a script of this folder
      new Function("async () => { await import(''); a?.b ?? (c ??= [1].at(-1)); }; class A { #b = 1; }");
      return !!([].at && window.ResizeObserver);
    } catch (error) {
      return false;
    }
  }

  // One sentence where a reader meets the first panel, the first exercise and the first puzzle.
  function refuse(words) {
    for (var i = 0; i < PLACES.length; i += 1) {
      var place = document.querySelector(PLACES[i]);
      if (place) {
        var note = document.createElement("p");
        note.className = "in-place-note";
        note.setAttribute("role", "status");
        note.appendChild(document.createTextNode(words));
        place.appendChild(note);
      }
    }
  }

  var style = document.createElement("link");
  style.rel = "stylesheet";
  style.href = here + "in_place.css";
  document.head.appendChild(style);
  if (isCurrent()) {
    var script = document.createElement("script");
    script.src = here + "offer.js";
    script.onerror = function () { refuse(NOT_THERE); };
    document.head.appendChild(script);
  } else if (document.readyState === "loading") {
    document.addEventListener("DOMContentLoaded", function () { refuse(TOO_OLD); });
  } else {
    refuse(TOO_OLD);
  }
})();
