"""stripy, which wraps STRIPACK: the triangulation alone, for it has no areas of cells. Called by voronoi.sh."""
import resource
import sys
import time

import numpy
import stripy

sites = numpy.fromfile(sys.argv[1], dtype="<f8").reshape(-1, 3)
lons, lats = stripy.spherical.xyz2lonlat(sites[:, 0], sites[:, 1], sites[:, 2])
times = []
for _ in range(int(sys.argv[3])):
    start = time.process_time()
    # The order is that of the sites, which the caller has shuffled: stripy's own shuffle would cost more.
    stripy.sTriangulation(lons, lats)
    times.append(time.process_time() - start)
print(min(times), "-", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
