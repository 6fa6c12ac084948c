"""The scenes of tests/tracer, written a second time, as polygons.

Nothing here is derived from the Rust code: a mistake in one of the two shows as a difference of the pictures.
A scene is a dict: polygons [(corners, reflectance)], lamp (corners counter-clockwise seen from where it shines, radiance),
eye, forward, right, up (right and up scaled by the tangent of half the vertical field of view).
"""

import math


def add(a, b, s=1.0):
    return tuple(x + s * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def camera(eye, target, tangent, mirrored=False):
    forward = unit(add(target, eye, -1.0))
    right = unit(cross(forward, (0.0, 1.0, 0.0)))
    up = cross(right, forward)
    side = -tangent if mirrored else tangent
    scale = lambda v, s: tuple(x * s for x in v)
    return {"eye": eye, "forward": forward, "right": scale(right, side), "up": scale(up, tangent)}


def rays(scene, size, pixels):
    """Origins and unit directions through the centres (x, y) of a size x size picture."""
    for x, y in pixels:
        across, above = (2.0 * x - size) / size, (size - 2.0 * y) / size
        direction = add(add(scene["forward"], scene["right"], across), scene["up"], above)
        yield scene["eye"], unit(direction)


def block(base, height, reflectance):
    """Four walls and a top over the corners (x, z) of a convex base."""
    top = [(x, height, z) for x, z in base]
    walls = []
    for i in range(4):
        (x0, z0), (x1, z1) = base[i], base[(i + 1) % 4]
        walls.append(([(x0, 0.0, z0), (x1, 0.0, z1), (x1, height, z1), (x0, height, z0)], reflectance))
    return walls + [(top, reflectance)]


def cornell(closed=False):
    white, red, green = (0.725, 0.71, 0.68), (0.63, 0.065, 0.05), (0.14, 0.45, 0.091)
    x, y, z = 556.0, 548.8, 559.2
    polygons = [
        ([(0, 0, 0), (x, 0, 0), (x, 0, z), (0, 0, z)], white),
        ([(0, y, 0), (x, y, 0), (x, y, z), (0, y, z)], white),
        ([(0, 0, z), (x, 0, z), (x, y, z), (0, y, z)], white),
        ([(x, 0, 0), (x, y, 0), (x, y, z), (x, 0, z)], red),
        ([(0, 0, 0), (0, y, 0), (0, y, z), (0, 0, z)], green),
    ]
    if closed:
        polygons.append(([(0, 0, 0), (x, 0, 0), (x, y, 0), (0, y, 0)], white))
    polygons += block([(130, 65), (82, 225), (240, 272), (290, 114)], 165, white)
    polygons += block([(423, 247), (265, 296), (314, 456), (472, 406)], 330, white)
    lamp = [(213, 548.3, 227), (343, 548.3, 227), (343, 548.3, 332), (213, 548.3, 332)]
    view = camera((278.0, 273.0, 10.0), (278.0, 273.0, 20.0), 0.9) if closed else camera(
        (278.0, 273.0, -800.0), (278.0, 273.0, 0.0), 0.0125 / 0.035)
    return {"polygons": polygons, "lamp": (lamp, (17.0, 12.0, 4.0)), "size": 560.0, **view}


def corridor(mirrored=False):
    wall, floor, h = (0.75, 0.75, 0.72), (0.5, 0.45, 0.4), 2.5
    upright = lambda x0, z0, x1, z1: ([(x0, 0, z0), (x1, 0, z1), (x1, h, z1), (x0, h, z0)], wall)
    flat = lambda y, x0, x1, z0, z1, rho: ([(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)], rho)
    polygons = [
        upright(0, 0, 0, 6), upright(0, 0, 2, 0), upright(2, 0, 2, 4), upright(2, 4, 6, 4), upright(6, 4, 6, 6),
        upright(0, 6, 6, 6),
        flat(0, 0, 2, 0, 6, floor), flat(0, 2, 6, 4, 6, floor), flat(h, 0, 2, 0, 6, wall), flat(h, 2, 6, 4, 6, wall),
    ]
    polygons += block([(0.6, 4.0), (1.2, 4.0), (1.2, 4.6), (0.6, 4.6)], 0.6, (0.65, 0.06, 0.05))
    lamp = [(5.98, 0.75, 4.5), (5.98, 0.75, 5.5), (5.98, 1.75, 5.5), (5.98, 1.75, 4.5)]
    view = camera((1.25, 1.35, 0.30), (0.95, 0.80, 6.0), math.tan(math.radians(25.0)), mirrored)
    return {"polygons": polygons, "lamp": (lamp, (24.0, 22.0, 19.0)), "size": 6.0, **view}


SCENES = {"cornell": cornell, "cornell_closed": lambda: cornell(closed=True), "corridor": corridor}
