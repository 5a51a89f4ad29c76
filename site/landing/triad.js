// The triad of the first page: three gyros that should stand at right angles, and may be bent.
"use strict";

const Triad = (() => {
  const { cross, dot, sum } = Drift;
  const DEGREE = Math.PI / 180;
  const STRAIGHT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const MOST = 15 * DEGREE; // that a gyro may lean

  // The unit vector that leans from another one by an angle, to the side where a third one is.
  function leaning(from, to, angle) {
    const across = sum(to, from, -dot(to, from));
    const length = Math.hypot(...across);
    if (length < 1e-12) return from;
    return sum(from.map((x) => x * Math.cos(angle)), across, Math.sin(angle) / length);
  }

  // By how much gyro i leans.
  const lean = (tips, i) =>
    Math.atan2(Math.hypot(...cross(tips[i], STRAIGHT[i])), dot(tips[i], STRAIGHT[i]));

  // The matrix M of the triad's errors: its rows are the gyros' axes less the straight ones. Of a
  // triad that is less bent each gyro leans to the same side, by a part of the angle.
  const errors = (tips, part = 1) =>
    tips.map((tip, i) => sum(leaning(STRAIGHT[i], tip, lean(tips, i) * part), STRAIGHT[i], -1));

  // Gyro i with its tip moved towards a place, as far as it may lean.
  const bentTo = (i, place) =>
    leaning(STRAIGHT[i], place, Math.min(MOST, Math.acos(Math.min(1, dot(place, STRAIGHT[i])))));

  return { DEGREE, MOST, STRAIGHT, bentTo, errors, lean, leaning };
})();
