"""Mean indirect luminances of the scenes by an independent path tracer: the constants of tests/scene_reference.rs.

    pip install mitsuba          # 3.9.1; its llvm variant wants LLVM 19 and DRJIT_LIBLLVM_PATH, else --variant scalar_rgb
    python benches/peers/reference.py --samples 4096 --bounces 1 2 4

Path integrator, maximum depth 2 + B minus maximum depth 2, rays through the centres (8i + 4.5, 8j + 4.5) of a 600 x 600
picture, over the pixels that see a surface that does not emit. Prints the mean luminance of B indirect bounces and its
standard error, from the scatter of batches.
"""

import argparse
import math

import numpy as np

from scenes import SCENES, rays

WEIGHTS = np.array([0.2126, 0.7152, 0.0722])


def load(mi, scene):
    def mesh(corners, reflectance, radiance=None):
        n = len(corners)
        properties = mi.Properties()
        rgb = lambda c: mi.load_dict({"type": "diffuse", "reflectance": {"type": "rgb", "value": list(c)}})
        bsdf = {"type": "twosided", "nested": {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(reflectance)}}}
        properties["bsdf"] = mi.load_dict(bsdf)
        if radiance:
            properties["emitter"] = mi.load_dict({"type": "area", "radiance": {"type": "rgb", "value": list(radiance)}})
        shape = mi.Mesh("polygon", n, n - 2, has_vertex_normals=False, has_vertex_texcoords=False, props=properties)
        parameters = mi.traverse(shape)
        parameters["vertex_positions"] = np.array(corners, dtype=np.float32).ravel()
        parameters["faces"] = np.array([(0, i, i + 1) for i in range(1, n - 1)], dtype=np.uint32).ravel()
        parameters.update()
        return shape

    shapes = {f"p{i}": mesh(corners, rho) for i, (corners, rho) in enumerate(scene["polygons"])}
    corners, radiance = scene["lamp"]
    shapes["lamp"] = mesh(corners, (0.0, 0.0, 0.0), radiance)
    return mi.load_dict({"type": "scene", **shapes})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--samples", type=int, default=4096)
    parser.add_argument("--bounces", type=int, nargs="+", default=[1, 2, 4])
    parser.add_argument("--scene", nargs="+", default=list(SCENES))
    options = parser.parse_args()
    import mitsuba as mi

    mi.set_variant(options.variant)
    import drjit as dr

    centres = [(8 * i + 4.5, 8 * j + 4.5) for j in range(75) for i in range(75)]
    for name in options.scene:
        scene = SCENES[name]()
        loaded = load(mi, scene)
        origins, directions = map(np.array, zip(*rays(scene, 600, centres)))
        ray = mi.Ray3f(mi.Point3f(*origins.T.astype(np.float32)), mi.Vector3f(*directions.T.astype(np.float32)))
        hit = loaded.ray_intersect(ray)
        seen = np.array(hit.is_valid()) & (np.array(dr.reinterpret_array(mi.UInt32, hit.emitter(loaded))) == 0)
        origins, directions = origins[seen], directions[seen]
        batch = 64
        repeated = lambda a: np.repeat(a, batch, axis=0).T.astype(np.float32)
        ray = mi.RayDifferential3f(mi.Ray3f(mi.Point3f(*repeated(origins)), mi.Vector3f(*repeated(directions))))

        def means(depth):
            integrator = mi.load_dict({"type": "path", "max_depth": depth, "rr_depth": 1000})
            values = []
            for index in range(math.ceil(options.samples / batch)):
                sampler = mi.load_dict({"type": "independent"})
                sampler.seed(1000 * depth + index, len(origins) * batch)
                radiance, _, _ = integrator.sample(loaded, sampler, ray)
                values.append(np.array(radiance).reshape(3, -1).mean(axis=1) @ WEIGHTS)
            return np.mean(values), np.std(values) / math.sqrt(len(values) - 1)

        direct, direct_error = means(2)
        print(f"{name}: {len(origins)} pixels, direct {direct:.6f} +- {direct_error:.6f}", flush=True)
        for bounces in options.bounces:
            all_light, error = means(2 + bounces)
            error = math.hypot(error, direct_error)
            print(f"{name}: {bounces} indirect bounces {all_light - direct:.6f} +- {error:.6f}", flush=True)


if __name__ == "__main__":
    main()
