"""Operating characteristics of Poisson, normal and exponential tests, to 25 digits: python3 sprt_families.py

Writes sprt_families.json beside it.  Needs mpmath.  Every input is the exact value of the double nearest to its decimal.

poisson      forward recursion on the total count, a dictionary of probabilities
normal       backward: the probability of acceptance from each node of a Gauss-Legendre rule of many more nodes than
             the answer needs, by solving the linear system of Nystrom's method, or look by look if truncated
exponential  forward: the undecided density times exp(-M y), held as the exact coefficients of its polynomials

Looks after `first`, then every `step`, and at `limit` if there is one.  N is the limit where the test is undecided.
"""
import json
import os
from functools import lru_cache
from mpmath import mp, mpf, log, exp, sqrt, floor, erfc, factorial, matrix, lu_solve, pi, cos

mp.dps = 60
DIGITS = 25


def bounds(alpha, beta):
    return log((1 - beta) / alpha), log(beta / (1 - alpha))


def looks(first, step, limit):
    n = 0
    while True:
        after = first if n < first else n + step
        if limit is not None:
            after = min(after, limit)
        yield after, after - n
        n = after


def finished(undecided, accept, reject, n, limit):
    return n == limit or undecided < mpf(10) ** -32 * min(max(accept, mpf(10) ** -60), max(reject, mpf(10) ** -60))


def poisson(rate0, rate1, alpha, beta, rate, first, step, limit):
    mp.dps = 60
    upper, lower = bounds(alpha, beta)
    event, each = log(rate1 / rate0), rate0 - rate1
    cells, accept, reject, mean = {0: mpf(1)}, mpf(0), mpf(0), mpf(0)
    for n, gap in looks(first, step, limit):
        mu, terms = gap * rate, [exp(-gap * rate)]
        while len(terms) < mu + 1 or terms[-1] > mpf(10) ** -60:
            terms.append(terms[-1] * mu / len(terms))
        # Integers in units of 10**-90 are several times faster than mpf.
        unit = 10 ** 90
        jumps, after = [int(term * unit) for term in terms], {}
        for x, p in cells.items():
            p = int(p * unit)
            for j, term in enumerate(jumps):
                after[x + j] = after.get(x + j, 0) + p * term
        after, cells = {x: mpf(p) / unit ** 2 for x, p in after.items()}, {}
        for x, p in after.items():
            ratio = x * event + n * each
            if ratio >= upper:
                reject += p
                mean += n * p
            elif ratio <= lower:
                accept += p
                mean += n * p
            elif p > mpf(10) ** -70:
                cells[x] = p
        undecided = sum(cells.values())
        if finished(undecided, accept, reject, n, limit):
            return accept, reject, undecided if n == limit else mpf(0), mean + n * undecided


def exponential(rate0, rate1, alpha, beta, rate, first, step, limit):
    upper, lower = bounds(alpha, beta)
    unit = log(rate1 / rate0)
    scale, fall = abs(unit), rate / abs(rate1 - rate0) * abs(unit)
    low, high = (lower / scale, upper / scale) if unit > 0 else (-upper / scale, -lower / scale)
    deepest = max(first, step) + 1
    # Breakpoints a whole number from the lower end, the start and the upper end, far enough to both sides.
    span = int(floor(high - low)) + 2 * deepest + 3
    cuts = sorted({low - deepest + i + o for i in range(span + 1) for o in (mpf(0), (-low) % 1, (high - low) % 1)})
    merged = [cuts[0]]
    for cut in cuts:
        if cut - merged[-1] > mpf(10) ** -40:
            merged.append(cut)
    cuts, period = merged, sum(1 for cut in merged if cut < merged[0] + 1 - mpf(10) ** -40)
    at = lambda y: min(range(len(cuts)), key=lambda i: abs(cuts[i] - y))
    kappa = fall * exp(-fall)
    widths = [cuts[i + 1] - cuts[i] for i in range(period)]
    integral = lambda poly, a, b: sum(c * (b ** (i + 1) - a ** (i + 1)) / (i + 1) for i, c in enumerate(poly))

    @lru_cache(None)
    def moment(i, width):
        # Integral of t**i exp(fall t) from 0 to width, by its series.
        total, term, k = mpf(0), width ** (i + 1), 0
        while k < 2 or term > mpf(10) ** -70 * total:
            total += term / (i + k + 1)
            k += 1
            term *= fall * width / k
        return total

    def mass(poly, left, width):
        return exp(fall * left) * sum(c * moment(i, width) for i, c in enumerate(poly))

    first_cut, last_cut = at(low), at(high)
    pieces = {}
    accept = reject = mean = mpf(0)
    for n, gap in looks(first, step, limit):
        if n == gap:
            start, pieces = at(mpf(0)), None
        below = mpf(0)
        for left in range(gap):
            keep = first_cut - period * (gap - 1 - left)
            after = {}
            if pieces is None:
                # A point at 0: h is constant up to the cut at 1.
                for q in range(keep, start + period):
                    after[q] = [kappa]
                below += exp(-fall * (1 - cuts[keep]))
                pieces = after
                continue
            above, sums = mpf(0), {}
            top = max(pieces) if pieces else keep
            bottom = min(pieces) if pieces else keep
            for q in range(top, bottom - 1, -1):
                sums[q + 1] = above
                above += integral(pieces[q], mpf(0), widths[q % period])
            below += exp(-fall * (1 - cuts[keep])) * above
            for q in range(keep, top + period + 1):
                source = q - period
                if source < bottom:
                    after[q] = [kappa * above]
                else:
                    poly, width = pieces[source], widths[source % period]
                    anti = [mpf(0)] + [c / (i + 1) for i, c in enumerate(poly)]
                    whole = sum(c * width ** i for i, c in enumerate(anti))
                    after[q] = [kappa * (whole + sums[source + 1])] + [-kappa * c for c in anti[1:]]
                    while len(after[q]) > 1 and not after[q][-1]:
                        after[q].pop()
            pieces = after
        over = sum((mass(pieces[q], cuts[q], widths[q % period]) for q in pieces if q >= last_cut), mpf(0))
        pieces = {q: poly for q, poly in pieces.items() if first_cut <= q < last_cut}
        undecided = sum((mass(pieces[q], cuts[q], widths[q % period]) for q in pieces), mpf(0))
        accept, reject = (accept + below, reject + over) if unit > 0 else (accept + over, reject + below)
        mean += n * (below + over)
        if finished(undecided, accept, reject, n, limit):
            return accept, reject, undecided if n == limit else mpf(0), mean + n * undecided


@lru_cache(None)
def legendre(count):
    nodes = []
    for i in range(count):
        x = cos(pi * (i + mpf(3) / 4) / (count + mpf(1) / 2))
        for _ in range(7):
            here, before = mpf(1), mpf(0)
            for j in range(1, count + 1):
                here, before = ((2 * j - 1) * x * here - (j - 1) * before) / j, here
            slope = count * (before - x * here) / (1 - x * x)
            x -= here / slope
            if abs(here / slope) < mpf(10) ** -45:
                break
        nodes.append((x, 2 / ((1 - x * x) * slope ** 2)))
    return nodes


def normal(mean0, mean1, deviation, alpha, beta, mean, first, step, limit, count):
    mp.dps = 45
    upper, lower = bounds(alpha, beta)
    shift = (mean1 - mean0) / deviation
    unit = abs(shift)
    low, high = lower / unit, upper / unit
    drift = (mean - (mean0 + mean1) / 2) / deviation * (1 if shift > 0 else -1)
    centre, half = (low + high) / 2, (high - low) / 2
    nodes = [(centre + half * x, half * w) for x, w in legendre(count)]
    tail = lambda z: erfc(z / sqrt(mpf(2))) / 2

    def leave(x, gap):
        root = sqrt(mpf(gap))
        return tail((x + gap * drift - low) / root), tail((high - x - gap * drift) / root)

    def density(x, gap):
        scale = sqrt(2 * pi * gap)
        return [w * exp(-(y - x - gap * drift) ** 2 / (2 * gap)) / scale for y, w in nodes]

    schedule = []
    if limit is None:
        # u = leave + K u, and N = step + K N.
        system, sides = matrix(count, count), [matrix(count, 1) for _ in range(3)]
        for i, (x, _) in enumerate(nodes):
            for j, k in enumerate(density(x, step)):
                system[i, j] = (1 if i == j else 0) - k
            sides[0][i], sides[1][i] = leave(x, step)
            sides[2][i] = mpf(step)
        values = [list(lu_solve(system, side)) for side in sides] + [[mpf(0)] * count]
    else:
        for n, gap in looks(first, step, limit):
            schedule.append(gap)
            if n == limit:
                break
        values = [[mpf(0)] * count, [mpf(0)] * count, [mpf(0)] * count, [mpf(1)] * count]
        rows, known = None, None
        for gap in reversed(schedule[1:]):
            if gap != known:
                rows, known = [(density(x, gap), leave(x, gap)) for x, _ in nodes], gap
            carried = [[mp.fdot(row, value) for row, _ in rows] for value in values]
            values = [
                [a + b for a, b in zip(carried[0], (exits[0] for _, exits in rows))],
                [a + b for a, b in zip(carried[1], (exits[1] for _, exits in rows))],
                [gap + a for a in carried[2]],
                carried[3],
            ]
    gap = schedule[0] if schedule else first
    row, exits = density(mpf(0), gap), leave(mpf(0), gap)
    accept, reject, after, undecided = (mp.fdot(row, value) for value in values)
    return accept + exits[0], reject + exits[1], undecided, gap + after


def case(family, names, inputs, schedule, extra=()):
    values = [mpf(float(text)) for text in inputs]
    first, step, limit = schedule
    accept, reject, undecided, mean = family(*values, first, step, limit, *extra)
    mp.dps = 60
    line = dict(zip(names, inputs), first=first, step=step, limit=limit)
    for name, value in (("accept", accept), ("reject", reject), ("undecided", undecided), ("mean_samples", mean)):
        line[name] = mp.nstr(value, DIGITS, min_fixed=1, max_fixed=0)
    print(family.__name__, line, flush=True)
    return line


EVERY = (1, 1, None)
RATES = ["rate0", "rate1", "alpha", "beta", "rate"]
MEANS = ["mean0", "mean1", "deviation", "alpha", "beta", "mean"]
POISSON = [
    (["2", "1", "0.05", "0.1", "1.5"], EVERY),
    (["1", "2", "1e-12", "1e-12", "1"], EVERY),
    (["1", "2", "1e-12", "1e-12", "2"], EVERY),
    (["0.001", "0.01", "0.05", "0.05", "0.001"], EVERY),
    (["10", "11", "0.05", "0.05", "10.5"], EVERY),
    (["100", "110", "1e-6", "0.1", "100"], EVERY),
    (["1000", "1001", "0.4", "0.4", "1000"], (1, 1, 12)),
    (["0.3", "0.4", "0.05", "0.05", "0.35"], (10, 2, 64)),
    (["0.3", "0.4", "0.05", "0.05", "0.3"], (1, 100, 350)),
    (["1", "1.5", "0.4999", "0.5", "1"], (3, 7, 20)),
    (["1", "2", "0.05", "0.05", "40"], EVERY),
    (["1", "2", "0.05", "0.05", "1e-6"], EVERY),
    (["3", "2", "0.01", "0.2", "3"], (5, 5, 25)),
]
NORMAL = [
    (["0", "1", "1", "1e-12", "1e-12", "0"], EVERY, 160),
    (["0", "1", "1", "1e-12", "1e-12", "0.5"], EVERY, 160),
    (["0", "1", "1", "1e-12", "1e-12", "-1"], EVERY, 160),
    (["0", "1", "1", "1e-12", "1e-12", "4"], EVERY, 160),
    (["0", "-2", "3", "0.01", "0.2", "-1"], EVERY, 100),
    (["0", "3", "1", "0.05", "0.05", "0"], EVERY, 60),
    (["0", "3", "1", "0.05", "0.05", "7"], EVERY, 60),
    (["0", "1", "1", "0.05", "0.05", "-5"], EVERY, 80),
    (["0", "1", "1", "0.05", "0.05", "20"], EVERY, 100),
    (["0", "0.3", "1", "0.05", "0.1", "0"], (10, 2, 64), 100),
    (["0", "0.3", "1", "0.05", "0.1", "0.2"], (10, 2, None), 100),
    (["0", "0.1", "1", "0.05", "0.05", "0.1"], (1, 100, 350), 160),
    (["0", "1", "1", "0.05", "0.05", "0.3"], (5, 3, 31), 80),
    (["0", "1", "1", "0.4999", "0.5", "0"], EVERY, 50),
    (["0", "1", "1", "0.05", "0.05", "0.5"], (1, 1, 1), 80),
    (["0", "0.1", "1", "0.05", "0.05", "0.05"], EVERY, 240),
    (["1000000", "1000000.5", "0.25", "1e-100", "1e-3", "1000000"], EVERY, 300),
]
EXPONENTIAL = [
    (["1", "2", "1e-12", "1e-12", "1"], EVERY),
    (["2", "1", "0.05", "0.1", "1"], EVERY),
    (["2", "1", "0.05", "0.1", "3"], EVERY),
    (["1", "1.3", "0.2", "0.2", "1.1"], EVERY),
    (["1", "1.1", "0.3", "0.3", "1.05"], EVERY),
    (["1", "1.02", "0.4", "0.4", "1"], (1, 1, 100)),
    (["1", "50", "0.05", "0.05", "1"], EVERY),
    (["1", "50", "0.05", "0.05", "50"], EVERY),
    (["1", "2", "0.05", "0.05", "20"], EVERY),
    (["1", "2", "0.05", "0.05", "30"], EVERY),
    (["1", "2", "0.05", "0.05", "50"], EVERY),
    (["1", "2", "0.05", "0.05", "1000"], EVERY),
    (["1", "2", "0.05", "0.05", "1e-3"], EVERY),
    (["1", "2", "0.05", "0.05", "1.5"], (5, 3, 31)),
    (["1", "2", "0.05", "0.05", "1.5"], (20, 1, None)),
    (["2", "1", "0.05", "0.05", "1.5"], (1, 7, 20)),
    (["1", "1.5", "0.4999", "0.5", "1"], EVERY),
    (["1", "2", "0.05", "0.05", "1.2"], (1, 1, 1)),
    (["1", "4", "0.2", "0.2", "2"], (3, 2, None)),
]

if __name__ == "__main__":
    # Some minutes, most of them for the longest tests.
    result = {
        "poisson": [case(poisson, RATES, *line) for line in POISSON],
        "exponential": [case(exponential, RATES, *line) for line in EXPONENTIAL],
        "normal": [case(normal, MEANS, inputs, schedule, (count,)) for inputs, schedule, count in NORMAL],
    }
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "sprt_families.json"), "w") as file:
        json.dump(result, file, indent=1)
        file.write("\n")
