"""CPU time and error of Radiance on the scenes, on the pixel rays of the light_vectors example.

    pip install pyradiance numpy          # ships rtrace and oconv
    cargo run --release --example light_vectors -- --sweep --size 600
    python benches/peers/radiance.py --size 600

The sweep runs it by itself in turns with the methods when it is given --radiance and a Python that has both.

Writes each scene as .rad, sends the ray of every pixel through rtrace with one ambient bounce and, for the direct light, with
none; the difference is the indirect light. Error: RMSE of its luminance over the mean, against the two halves of the
reference that the example keeps in target/light_vectors/references. Time: user and system seconds of the rtrace with the
ambient bounce, less those of the one without, so that nobody pays for the direct light of the pixels. Prints a table and the
time at which the error is 7 %.
"""

import argparse
import math
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

from scenes import SCENES, corridor, rays

# Ambient accuracy, resolution, divisions, supersamples: from fast to good.
SETTINGS = {
    "cornell": [(0.6, 8, 512, 0), (0.5, 16, 512, 0), (0.5, 16, 1024, 0), (0.4, 16, 1024, 0), (0.3, 32, 256, 64)],
    "corridor": [(0.7, 8, 512, 0), (0.5, 16, 512, 0), (0.5, 16, 1024, 0), (0.3, 32, 256, 64), (0.3, 32, 1024, 0)],
}


def rad(scene):
    """The scene as a Radiance description; surfaces are one-sided lights and two-sided plastics without gloss."""
    lines = []
    for i, (corners, rho) in enumerate(scene["polygons"]):
        lines.append(f"void plastic m{i} 0 0 5 {rho[0]} {rho[1]} {rho[2]} 0 0")
        numbers = " ".join(str(x) for corner in corners for x in corner)
        lines.append(f"m{i} polygon p{i} 0 0 {3 * len(corners)} {numbers}")
    corners, radiance = scene["lamp"]
    lines.append(f"void light lamp 0 0 3 {radiance[0]} {radiance[1]} {radiance[2]}")
    lines.append(f"lamp polygon shining 0 0 12 {' '.join(str(x) for corner in corners for x in corner)}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=600)
    parser.add_argument("--rays", type=int, default=1024, help="rays per pixel of the reference")
    parser.add_argument("--scene", nargs="+", choices=list(SETTINGS), default=list(SETTINGS))
    parser.add_argument("--points", action="store_true", help="print 'CPU seconds,RMSE over mean' only")
    parser.add_argument("--references", type=pathlib.Path, default=pathlib.Path("target/light_vectors/references"))
    options = parser.parse_args()
    try:
        import numpy as np
        import pyradiance
    except ImportError as error:
        print(f"skipped: {error}; pip install pyradiance numpy")
        return
    home = pathlib.Path(pyradiance.__file__).parent
    environment = {**os.environ, "RAYPATH": f".:{home / 'lib'}", "PATH": f"{home / 'bin'}:{os.environ['PATH']}"}
    size, weights = options.size, np.array([0.2126, 0.7152, 0.0722])
    for name in options.scene:
        settings = SETTINGS[name]
        scene = corridor(mirrored=True) if name == "corridor" else SCENES[name]()
        kept = options.references / f"reference_{name}_{size}_{options.rays}.csv"
        if not kept.exists():
            print(f"skipped {name}: no reference of {size} x {size} in {options.references}; run the example first")
            continue
        table = np.loadtxt(kept, delimiter=",")
        halves = table[:, :3] @ weights, table[:, 3:] @ weights
        centres = [(x + 0.5, y + 0.5) for y in range(size) for x in range(size)]
        sent = np.array([[*origin, *direction] for origin, direction in rays(scene, size, centres)], dtype=np.float32)
        lit = (halves[0] > 0) | (halves[1] > 0)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "scene.rad").write_text(rad(scene))
            tree = subprocess.run(["oconv", "scene.rad"], cwd=folder, env=environment, check=True, capture_output=True).stdout
            (folder / "scene.oct").write_bytes(tree)

            def trace(arguments):
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                common = ["-dj", "0", "-ds", ".5", "-dt", "0", "-dc", "1", "-lw", "1e-6"]
                command = ["rtrace", "-h", "-fff", *arguments, *common, "scene.oct"]
                out = subprocess.run(command, cwd=folder, env=environment, check=True, input=sent.tobytes(), capture_output=True)
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
                return np.frombuffer(out.stdout, dtype=np.float32).reshape(-1, 3).astype(float), seconds

            direct, without = trace(["-ab", "0"])
            curve = []
            for accuracy, resolution, divisions, supersamples in settings:
                ambient = folder / "scene.amb"
                ambient.unlink(missing_ok=True)
                arguments = ["-ab", "1", "-aa", accuracy, "-ar", resolution, "-ad", divisions, "-as", supersamples, "-af", ambient.name]
                both, seconds = trace([str(argument) for argument in arguments])
                indirect = (both - direct) @ weights
                a, b = (half[lit] for half in halves)
                square = np.mean((indirect[lit] - a) * (indirect[lit] - b))
                mean = 0.5 * np.mean(a + b)
                rmse, bias = math.sqrt(max(square, 0.0)) / mean, np.mean(indirect[lit] - 0.5 * (a + b)) / mean
                curve.append((seconds - without, rmse))
                if options.points:
                    print(f"{seconds - without},{rmse}", flush=True)
                    continue
                print(
                    f"{name:9} aa {accuracy} ar {resolution:2} ad {divisions:4} as {supersamples:2}"
                    f"  {seconds - without:6.2f} CPU s  RMSE/mean {100 * rmse:5.2f} %  bias {100 * bias:+.2f} %",
                    flush=True,
                )
            if options.points:
                continue
            good = sorted(curve)
            for (t0, e0), (t1, e1) in zip(good, good[1:]):
                if e0 >= 0.07 > e1:
                    share = math.log(e0 / 0.07) / math.log(e0 / e1)
                    print(f"{name:9} 7 % after {math.exp(math.log(t0) * (1 - share) + math.log(t1) * share):.2f} CPU s")
                    break
            else:
                best = min(curve, key=lambda point: point[1])
                print(f"{name:9} 7 % is not crossed; the best is {100 * best[1]:.2f} % after {best[0]:.2f} CPU s")


if __name__ == "__main__":
    sys.exit(main())
