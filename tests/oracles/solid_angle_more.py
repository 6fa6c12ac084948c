"""Moments of the polygons of solid_angle.json, and more polygons with both, to 40 digits.

Needs: mpmath.  Usage: python3 solid_angle_more.py solid_angle.json solid_angle_more.json

Vertices are doubles exactly as stored; each is normalised in 400-digit arithmetic before use.
omega_signed: twice the argument of the product of 1 + a.b + b.c + c.a + i det(a, b, c) over a fan about an apex that is
no vertex, in (-2 pi, 2 pi]; two apexes must agree.  moment: half the sum of theta n over the edges.
"""
import json
import random
import sys

import mpmath as mp

mp.mp.dps = 400
random.seed(20261123)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    v = [mp.mpf(x) for x in v]
    n = mp.sqrt(dot(v, v))
    return [x / n for x in v]


def omega_about(apex, vs):
    z = mp.mpc(1)
    for a, b in zip(vs, vs[1:] + vs[:1]):
        z *= mp.mpc(1 + dot(apex, a) + dot(a, b) + dot(b, apex), dot(apex, cross(a, b)))
        z /= abs(z)
    return 2 * mp.arg(z)


def omega(vs):
    first, second = (omega_about(unit([random.gauss(0, 1) for _ in range(3)]), vs) for _ in range(2))
    apart = abs(first - second) / (4 * mp.pi)
    assert min(apart, 1 - apart) < mp.mpf(10) ** -180, (first, second)
    return first


def moment(vs):
    m = [mp.mpf(0)] * 3
    for a, b in zip(vs, vs[1:] + vs[:1]):
        c = cross(a, b)
        s = mp.sqrt(dot(c, c))
        if s != 0:
            f = mp.atan2(s, dot(a, b)) / s / 2
            m = [x + f * y for x, y in zip(m, c)]
    return m


def text(x):
    return "0" if abs(x) < mp.mpf(10) ** -350 else mp.nstr(x, 40, min_fixed=1, max_fixed=0, strip_zeros=False)


def f64(v):
    return [float(x) for x in v]


def gauss():
    return [random.gauss(0, 1) for _ in range(3)]


def direction():
    return f64(unit(gauss()))


def around(centre, e1, e2, x, y):
    return [c + x * p + y * q for c, p, q in zip(centre, e1, e2)]


def frame():
    c = unit(gauss())
    e1 = unit(cross(c, unit(gauss())))
    return c, e1, cross(c, e1)



def scaled(v, s):
    return [x * s for x in v]


def star(n, scale, r0=0.3, loose=0.0):
    c, e1, e2 = frame()
    out = []
    for i in range(n):
        t = 2 * mp.pi * (i + random.uniform(0, 0.8)) / n
        r = scale * random.uniform(r0, 1)
        v = unit(around(c, e1, e2, r * mp.cos(t), r * mp.sin(t)))
        out.append(f64(scaled(v, 1 + random.uniform(-loose, loose))))
    return out


cases = []


def case(cls, vertices):
    cases.append((cls, vertices))


LOOSE = 4.4e-13
for _ in range(30):
    case("random_triangle", [direction() for _ in range(3)])
for _ in range(10):
    case("random_quad", [direction() for _ in range(4)])
for scale in ["0.5", "1e-2", "1e-5", "1e-8"]:
    for n in (3, 6):
        for _ in range(3):
            case("star_" + scale, star(n, mp.mpf(scale)))
            case("loose_star_" + scale, star(n, mp.mpf(scale), loose=LOOSE))
for eps in ["1e-2", "1e-4", "1e-6", "1e-9", "1e-12", "1e-15"]:
    for loose in (0.0, LOOSE):
        for _ in range(3):
            c, e1, e2 = frame()
            t = random.uniform(0, 6.28)
            far = unit(around([-x for x in c], e1, e2, mp.mpf(eps) * mp.cos(t), mp.mpf(eps) * mp.sin(t)))
            tri = [f64(scaled(v, 1 + random.uniform(-loose, loose))) for v in (c, far, unit(gauss()))]
            case(("loose_" if loose else "") + "near_antipodal_" + eps, tri)
            # Two nearly antipodal edges: a and c close together, b on the other side.
            near = unit(around(c, e1, e2, mp.mpf(eps) * mp.cos(t + 1), mp.mpf(eps) * mp.sin(t + 1)))
            tri = [f64(scaled(v, 1 + random.uniform(-loose, loose))) for v in (c, far, near)]
            case(("loose_" if loose else "") + "twice_antipodal_" + eps, tri)
for x, y in [(1e-20, 0.0), (1e-20, 1e-25), (1e-60, -1e-62), (1e-100, 0.0)]:
    third = direction()
    case("axis_antipodal", [[1.0, 0.0, 0.0], [-1.0, x, y], third])
    case("axis_antipodal", [third, [1.0, 0.0, 0.0], [-1.0, x, y]])
    case("axis_antipodal", [[1.0, 0.0, 0.0], third, [-1.0, x, y], direction()])
for length in ["1", "1e-2", "1e-4"]:
    for h in ["1e-3", "1e-6", "1e-9", "1e-12"]:
        for _ in range(2):
            c, e1, e2 = frame()
            l = mp.mpf(length)
            vs = [around(c, e1, e2, 0, 0), around(c, e1, e2, l, 0), around(c, e1, e2, l * random.uniform(0.2, 0.8), l * mp.mpf(h))]
            case("needle_" + h, [f64(unit(v)) for v in vs])
for _ in range(6):
    case("complement", star(6, mp.mpf("0.3"))[::-1])
for width in ["1e-3", "1e-7"]:
    c, e1, e2 = frame()
    w = mp.mpf(width)
    lower = [around(c, e1, e2, mp.mpf(i) / 10, mp.mpf(i * i) / 300) for i in range(11)]
    upper = [around(c, e1, e2, mp.mpf(i) / 10, mp.mpf(i * i) / 300 + w) for i in range(11)]
    case("band_" + width, [f64(unit(v)) for v in lower + upper[::-1]])

oracle = json.load(open(sys.argv[1]))
moments = {}
for p in oracle["polygons"]:
    if p["expect"] == "value" and p["cls"] != "non_unit":
        vs = [unit([float.fromhex(x) for x in v]) for v in p["vertices"]]
        moments[p["id"]] = [text(x) for x in moment(vs)]
polygons = []
for number, (cls, vertices) in enumerate(cases):
    vs = [unit(v) for v in vertices]
    polygons.append(
        {
            "id": f"{cls}_{number:03}",
            "cls": cls,
            "vertices": [[float(x).hex() for x in v] for v in vertices],
            "omega_signed": text(omega(vs)),
            "moment": [text(x) for x in moment(vs)],
        }
    )
with open(sys.argv[2], "w") as out:
    json.dump({"format": 1, "moments": moments, "polygons": polygons}, out, indent=0)
    out.write("\n")
print(len(moments), "moments,", len(polygons), "polygons")
