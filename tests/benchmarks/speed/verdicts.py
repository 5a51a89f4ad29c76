"""Who wins a row: a fast wrong answer loses."""

from .measuring import EQUAL, Ratio, Result, Target, Timing, ratio


def verdict(result: Result, peer: Timing) -> str:
    """What a peer's time and error say of ours, in a few words."""
    slower = ratio(peer, result.ours)
    exactness = _exactness(result, peer)
    if slower.low > 1:
        return {-1: "slower, less exact", 0: "slower", 1: "slower, **more exact**"}[exactness]
    if slower.high < 1:
        return {-1: "faster, less exact", 0: "**faster**", 1: "**faster, more exact**"}[exactness]
    return {-1: "as fast, less exact", 0: "as fast", 1: "as fast, **more exact**"}[exactness]


def ahead_of(result: Result, peer: Timing) -> bool:
    """Whether ours is faster at an equal or smaller error, or a faster peer is plainly wronger."""
    exactness = _exactness(result, peer)
    return exactness < 0 or (exactness == 0 and ratio(peer, result.ours).low > 1)


def _exactness(result: Result, peer: Timing) -> int:
    """1 where the peer is more exact than ours, -1 where less, 0 where they are equal."""
    if peer.error is None or result.ours.error is None:
        return 0
    theirs, ours = (max(error, result.row.rounding) for error in (peer.error, result.ours.error))
    return int(ours > EQUAL * theirs) - int(theirs > EQUAL * ours)


def reached(result: Result, target: Target) -> Ratio | None:
    """Ours in the target's terms: a ratio, or seconds; None where the other was left out."""
    if target.than is None:
        low, high = min(result.ours.seconds), max(result.ours.seconds)
        return Ratio(result.ours.median, low, high)
    other = result.others.get(target.than)
    return None if other is None else ratio(result.ours, other)


def is_met(result: Result, target: Target) -> bool | None:
    """Whether the median reaches a target; None where it could not be held against it."""
    found = reached(result, target)
    return None if found is None else found.median <= target.most
