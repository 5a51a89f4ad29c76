// What the first page computes: a turn, what a bent triad makes of it, and the drift that is left.
// A classic script, not a module, so that a page opened from a disk has it too.
"use strict";

const Drift = (() => {
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
  const sum = (a, b, share = 1) => a.map((x, i) => x + share * b[i]);
  const unit = (a) => a.map((x) => x / Math.hypot(...a));
  const times = (matrix, a) => matrix.map((row) => dot(row, a));

  // 2 pi (|A n| - 1) in rad, with A = E + M and a unit vector n, without loss of digits.
  function perTurn(M, n) {
    const e = times(M, n);
    return (2 * Math.PI * (2 * dot(n, e) + dot(e, e))) / (Math.hypot(...sum(n, e)) + 1);
  }

  // A vector turned by a rotation vector; Rodrigues.
  function turned(a, rotation) {
    const angle = Math.hypot(...rotation);
    if (angle === 0) return a;
    const n = rotation.map((x) => x / angle);
    const along = sum(a.map((x) => x * Math.cos(angle)), cross(n, a), Math.sin(angle));
    return sum(along, n, dot(n, a) * (1 - Math.cos(angle)));
  }

  // What a computer that believes its gyros has for the rotation vector of a turn about n.
  const believed = (M, n, angle) => sum(n, times(M, n)).map((x) => x * angle);

  // The angle between the true attitude and the computed one, from 0 to pi.
  function error(M, n, angle) {
    const [c, s] = [Math.cos(angle / 2), Math.sin(angle / 2)];
    const measured = believed(M, n, 0.5);
    const half = Math.hypot(...measured);
    const p = measured.map((x) => (x / half) * Math.sin(half * angle));
    const q = n.map((x) => x * s);
    const scalar = c * Math.cos(half * angle) + dot(q, p);
    const vector = sum(sum(p.map((x) => x * c), q, -Math.cos(half * angle)), cross(q, p), -1);
    return 2 * Math.atan2(Math.hypot(...vector), Math.abs(scalar));
  }

  // The axis about which most is left after a turn: where |A n| is greatest or least. That is an
  // eigenvector of S = A^T A - E, found by repetition. E is left out and S shifted by its own size,
  // since the eigenvalues of A^T A itself are all but equal where the bend is small.
  function worst(M) {
    const columns = [0, 1, 2].map((j) => M.map((row) => row[j]));
    const S = columns.map((a, i) => columns.map((b, j) => M[i][j] + M[j][i] + dot(a, b)));
    const size = Math.hypot(...S.flat());
    let [most, least] = [unit([0.5, 0.6, 0.62]), unit([0.62, -0.6, 0.5])];
    if (size === 0) return most; // nothing is left about any axis
    for (let k = 0; k < 500; k++) {
      most = unit(sum(times(S, most), most, size));
      least = unit(sum(times(S, least), least, -size));
    }
    return Math.abs(perTurn(M, most)) < Math.abs(perTurn(M, least)) ? least : most;
  }

  // An axis about which nothing is left, neither of this triad nor of one that is bent less: by
  // damped Newton steps from a direction, or from the first of many others that leads to one.
  function without(M, less, direction) {
    const left = (n) => [perTurn(M, n), 100 * perTurn(less, n)];
    const others = Array.from({ length: 200 }, (_, k) => {
      const around = Math.sqrt(1 - (k / 200) ** 2);
      return [around * Math.cos(2.4 * k), around * Math.sin(2.4 * k), k / 200];
    });
    for (let n of [direction, ...others]) {
      for (let k = 0; k < 60; k++) {
        const side = unit(cross(n, Math.abs(n[2]) < 0.7 ? [0, 0, 1] : [1, 0, 0]));
        const here = left(n);
        const steps = [side, cross(n, side)].map((across) => {
          const there = left(unit(sum(n, across, 1e-6)));
          return { across, slope: there.map((x, i) => (x - here[i]) / 1e-6) };
        });
        const [a, b] = steps.map(({ slope }) => slope);
        const inner = (x, y) => x[0] * y[0] + x[1] * y[1];
        const [aa, ab, bb] = [inner(a, a) + 1e-7, inner(a, b), inner(b, b) + 1e-7];
        const [ar, br] = [inner(a, here), inner(b, here)];
        const scale = -1 / (aa * bb - ab * ab);
        n = sum(n, steps[0].across, scale * (bb * ar - ab * br));
        n = unit(sum(n, steps[1].across, scale * (aa * br - ab * ar)));
      }
      if (Math.hypot(...left(n)) < 1e-6) return n;
    }
    return direction;
  }

  return { dot, cross, sum, unit, turned, believed, perTurn, error, worst, without };
})();
