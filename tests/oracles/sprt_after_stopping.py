"""Exact inference after Bernoulli tests, from integer path counts: writes sprt_after_stopping.json beside itself.

Needs mpmath. The boundaries are decided in rational arithmetic on the decimals as written; probabilities are those of
the double nearest each decimal, as the library gets it.
"""

import json
import pathlib
from fractions import Fraction
from functools import cache

import mpmath
from mpmath import mpf

mpmath.mp.dps = 60

ABOUT = (
    "Exact inference after a Bernoulli test, stage-wise order by evidence for H1: of rejections the earlier is larger, "
    "of acceptances the later; inside one look, and for an exhausted outcome at the limit, by the hits (successes if "
    "p1 > p0, else failures). p_value: P_p0(outcome >= observed). interval: each limit leaves (1 - level)/2 to the "
    "outcomes at least as far out. median_unbiased: P(>) + P(=)/2 = 1/2."
)

BRIEF = ("0.1", "0.3", "0.05", "0.1")
NARROW = ("0.45", "0.55", "0.44", "0.55")
# (p0, p1, alpha, beta), first look, step, limit, [(n, successes)]
CASES = [
    (BRIEF, 1, 1, None, [(3, 3), (9, 4), (20, 6), (9, 0), (20, 2), (36, 5)]),
    (BRIEF, 10, 2, 64, [(10, 6), (10, 5), (14, 6), (10, 0), (16, 1), (64, 11), (64, 12), (64, 13), (64, 10)]),
    (NARROW, 10, 2, 64, [(10, 6), (10, 4), (12, 7), (12, 5), (64, 32), (64, 33)]),
    (("0.3", "0.1", "0.05", "0.1"), 1, 1, None, [(12, 0), (3, 3), (9, 4), (33, 4), (36, 9)]),
    (("0.9", "0.7", "0.05", "0.1"), 1, 1, None, [(3, 0), (9, 5), (9, 9), (36, 31)]),
    (("0.2", "0.6", "0.3", "0.1"), 1, 1, 7, [(1, 1), (7, 2), (7, 3), (3, 0)]),
    (("0.001", "0.01", "0.05", "0.05"), 1, 1, None, [(2, 2), (9, 2), (350, 3), (700, 5), (326, 0)]),
    (("0.5", "0.6", "0.05", "0.05"), 1, 1, 200, [(17, 17), (106, 66), (108, 52), (200, 110), (200, 111), (17, 2)]),
]


@cache
def paths(design, first, step, limit, end):
    """Path counts to the cells that stop by `end`: [(n, hits, count, decision)] and the cells at `end` itself."""
    p0, p1, alpha, beta = map(Fraction, design)
    upper, lower = (1 - beta) / alpha, beta / (1 - alpha)
    rising = p1 > p0
    up, down = (p1 / p0, (1 - p1) / (1 - p0)) if rising else ((1 - p1) / (1 - p0), p1 / p0)
    live, stopped = {0: 1}, []
    for n in range(1, end + 1):
        grown = {}
        for hits, count in live.items():
            grown[hits] = grown.get(hits, 0) + count
            grown[hits + 1] = grown.get(hits + 1, 0) + count
        live = grown
        look = n == limit or (n >= first and (n - first) % step == 0)
        decision = {}
        if look:
            for hits in live:
                ratio = up**hits * down ** (n - hits)
                decision[hits] = "reject" if ratio >= upper else "accept" if ratio <= lower else None
        if n == end:
            return stopped, sorted(live.items()), decision
        for hits, verdict in decision.items():
            if verdict:
                stopped.append((n, hits, live.pop(hits), verdict))


def find(design, first, step, limit, n, successes):
    rising = Fraction(design[1]) > Fraction(design[0])
    hits = successes if rising else n - successes
    stopped, cells, decision = paths(design, first, step, limit, n)
    if hits not in dict(cells) or not (decision.get(hits) or n == limit):
        return None
    larger = [(m, h, c) for m, h, c, d in stopped if d == "reject"] + [(n, h, c) for h, c in cells if h > hits]
    smaller = [(m, h, c) for m, h, c, d in stopped if d == "accept"] + [(n, h, c) for h, c in cells if h < hits]
    equal = [(n, h, c) for h, c in cells if h == hits]

    def mass(points, p):
        hit = p if rising else 1 - p
        return mpmath.fsum(c * hit**h * (1 - hit) ** (m - h) for m, h, c in points)

    # Towards more successes.
    more, less = (larger, smaller) if rising else (smaller, larger)

    def root(function, at_zero, at_one):
        """The zero of an increasing function, from its signs at 0 and 1, by bisection."""
        if at_zero:
            return mpf(0)
        if at_one:
            return mpf(1)
        low, high = mpf(0), mpf(1)
        for _ in range(180):
            middle = (low + high) / 2
            low, high = (low, middle) if function(middle) > 0 else (middle, high)
        return low

    none, all_ = successes == 0, successes == n
    interval = {}
    for level in ["0.5", "0.95", "0.999"]:
        tail = (1 - mpf(level)) / 2
        interval[level] = [
            root(lambda p: mass(more + equal, p) - tail, none, False),
            root(lambda p: tail - mass(less + equal, p), False, all_),
        ]
    text = lambda x: mpmath.nstr(x, 25)
    return {
        "n": n,
        "successes": successes,
        "decision": decision.get(hits) or "exhausted",
        "p_value": text(mass(larger + equal, mpf(float(design[0])))),
        "interval": {level: list(map(text, limits)) for level, limits in interval.items()},
        "median_unbiased": text(root(lambda p: mass(more, p) + mass(equal, p) / 2 - mpf(1) / 2, none, all_)),
    }


def main():
    designs = []
    for design, first, step, limit, ends in CASES:
        found = [(end, find(design, first, step, limit, *end)) for end in ends]
        for end, case in found:
            if case is None:
                print("no outcome:", design, end)
        keys = ["p0", "p1", "alpha", "beta"]
        designs.append(
            dict(zip(keys, design)) | {"first": first, "step": step, "limit": limit, "cases": [c for _, c in found if c]}
        )
    target = pathlib.Path(__file__).with_suffix(".json")
    target.write_text(json.dumps({"about": ABOUT, "designs": designs}, indent=1) + "\n")


if __name__ == "__main__":
    main()
