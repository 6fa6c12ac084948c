#!/usr/bin/env python3
"""Writes the committed inputs of the Voronoi and solid angle targets into fuzz/corpus/, named by what they are.

The bytes are those that `arbitrary` 1 decodes: integers and doubles little-endian, the variant of n of an enum as a u32 k/n of
2**32, and before each item of a vector at the end an odd byte.
"""
import json
import pathlib
import struct

HERE = pathlib.Path(__file__).resolve().parent
# The order of `KINDS` in tests/invariants/voronoi_sites.rs.
KINDS = """uniform upper_half lattice rings great_circle small_circle tilted_circle solids cubed_sphere integers perturbed
all_exponents repeated near_duplicates cap_3 cap_6 cap_8 cap_10 cap_12 cap_14 cap_16 clusters_3 clusters_6 clusters_10
clusters_14 clusters_16""".split()


def variant(k, n):
    return struct.pack("<I", -(-k * 2**32 // n))


def vector(items):
    return b"".join(b"\1" + item for item in items) + b"\0"


def sites(points):
    return vector(struct.pack("<3d", *map(float, point)) for point in points)


AXIS_Z, POLE_AT_FIRST = variant(0, 5) + b"\2", variant(1, 5) + b"\0"
BISECTOR, THROUGH = variant(2, 5) + b"\0\1", variant(3, 5) + b"\0\1"
ULPS, DUPLICATE = variant(0, 10) + b"\0\1\xff\0", variant(1, 10) + b"\1"
ANTIPODE, NEAR = variant(2, 10) + b"\0", variant(3, 10) + b"\0\x0c\x40\x20\xe0"
MIDDLE, MIRROR, SCALE = variant(4, 10) + b"\0\1", variant(5, 10) + b"\0\2", variant(6, 10) + b"\1\x60"

ON_CIRCLE = [variant(8, 10) + bytes([0, 1, 2, turn, turn % 3, 2, 255 - turn % 2]) for turn in (40, 90, 140, 190, 240)]


def tiny(digits):
    return variant(9, 10) + bytes([0, digits - 30, 1])


def shape(kind, n, pole=AXIS_Z, edits=()):
    return struct.pack("<3B", KINDS.index(kind), n - 1, 1) + pole + vector(edits)


def shapes():
    for kind in KINDS:
        yield f"shape_{kind}", shape(kind, 12)
    yield "one_site", shape("uniform", 1)
    yield "two_sites_horizon_on_their_bisector", shape("uniform", 2, BISECTOR)
    yield "three_sites_horizon_through_two", shape("uniform", 3, THROUGH)
    yield "lattice_horizon_through_two", shape("lattice", 16, THROUGH)
    yield "great_circle_and_a_site_an_ulp_off", shape("great_circle", 8, AXIS_Z, [ULPS])
    yield "octahedron_pole_at_a_site", shape("solids", 6, POLE_AT_FIRST)
    yield "random_with_duplicate_antipode_middle", shape("uniform", 9, BISECTOR, [DUPLICATE, ANTIPODE, MIDDLE, MIRROR])
    for kind in ["uniform", "small_circle", "tilted_circle", "cap_3"]:
        yield f"{kind}_and_sites_almost_on_its_circles", shape(kind, 5, AXIS_Z, ON_CIRCLE)
    for kind in ["great_circle", "integers", "solids"]:
        for digits in (60, 90, 120):
            yield f"{kind}_off_by_{digits}_bits", shape(kind, 8, AXIS_Z, [tiny(digits)])
    yield "lattice_with_near_duplicates_and_scales", shape("lattice", 9, AXIS_Z, [NEAR, NEAR, ULPS, SCALE])


def cases():
    text = (HERE.parent / "tests/oracles/voronoi.json").read_text()
    oracle = json.loads(text)
    for case in oracle["cases"]:
        if len(case["sites"]) <= 12:
            yield case["name"], case["sites"]
    for case in oracle["invalid"]:
        yield "invalid_" + case["name"], case["sites"]


def write(target, files):
    folder = HERE / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in files:
        (folder / name).write_bytes(data)


for target in ["voronoi_structured", "voronoi_slow", "voronoi_symmetry"]:
    write(target, shapes())
write("voronoi_circles", [(name, variant(1, 2) + data) for name, data in shapes()])
DUPLICATE_MET_FIRST = [(2.0**-16, 5e-324, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 1e-310), (0.0, 1.0, 0.0), (1e-314, 0.0, 0.0)]
no_pole, up = b"\0" + bytes(24), b"\1" + struct.pack("<3d", 0.0, 0.0, 1.0)
write("voronoi_raw", [(name, no_pole + sites(points)) for name, points in cases()])
write("voronoi_raw", [("pole_zero", b"\1" + bytes(24) + sites([(1.0, 0.0, 0.0)])), ("no_sites", up + b"\0")])
write("voronoi_raw", [("duplicate_met_first", no_pole + sites(DUPLICATE_MET_FIRST))])
write("voronoi_raw", [(f"dome_{name}", up + sites(points)) for name, points in cases() if len(points) <= 6])

RAW = variant(0, 5)


def loop(normal, vertices):
    return RAW + struct.pack("<3d", *normal) + vector(RAW + struct.pack("<3d", *v) for v in vertices)


S, X = 0.5773502691896258, (1.0, 0.0, 0.0)
TO_AND_FRO = [(0.3397824457863874, -0.863047412297424, -0.3737606903650261), (S, S, S)]
TO_AND_FRO += [(-0.577350269189636, -0.5773502691896257, -0.577350269189616)]
TO_AND_FRO += [(0.5773502691896261, 0.5773502691896159, 0.5773502691896061)]
TO_AND_FRO += [(-0.5773502691896162, -0.577350269189606, -0.5773502691895962)]
SLIVER = [(S, S, S), (0.5773502691896379, 0.5773502691896157, 0.5773502691896184)]
SLIVER += [(-0.5773502691896305, -0.5773502691896083, -0.577350269189611), (-1.0, 0.0, 0.0)]
SMALLEST = [X, (-1.0 - 2.0**-46, -3.8e-322, -3.8e-322), (0.6, -0.8, 0.0)]
GRAZING = (0.3465791652140675, -0.663280816185543, -0.663280816185543)
write("solid_angle", [("to_and_fro", loop(X, TO_AND_FRO)), ("sliver_across_the_horizon", loop(GRAZING, SLIVER))])
write("solid_angle", [("half_turn_of_smallest_doubles", loop(X, SMALLEST))])
