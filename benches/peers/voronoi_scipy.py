"""scipy.spatial.SphericalVoronoi: cells, sorted, and their areas. Called by voronoi.sh."""
import resource
import sys
import time

import numpy
from scipy.spatial import ConvexHull, SphericalVoronoi

sites = numpy.fromfile(sys.argv[1], dtype="<f8").reshape(-1, 3)
hull, total = [], []
for _ in range(int(sys.argv[3])):
    start = time.process_time()
    ConvexHull(sites)
    hull.append(time.process_time() - start)
    start = time.process_time()
    diagram = SphericalVoronoi(sites)
    diagram.sort_vertices_of_regions()
    areas = diagram.calculate_areas()
    total.append(time.process_time() - start)
areas.astype("<f8").tofile(sys.argv[2])
print(min(hull), min(total), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
