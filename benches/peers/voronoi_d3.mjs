// d3-geo-voronoi: Delaunay triangulation; its polygons and d3-geo's areas of them. Called by voronoi.sh.
import { readFileSync, writeFileSync } from "node:fs";
import { geoDelaunay } from "d3-geo-voronoi";
import { geoArea } from "d3-geo";

const [sitesFile, areasFile, repeat] = process.argv.slice(2);
const bytes = readFileSync(sitesFile);
const xyz = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8);
const points = [];
for (let i = 0; i < xyz.length; i += 3) {
  const [x, y, z] = xyz.subarray(i, i + 3);
  points.push([(Math.atan2(y, x) * 180) / Math.PI, (Math.atan2(z, Math.hypot(x, y)) * 180) / Math.PI]);
}
const seconds = () => { const { user, system } = process.cpuUsage(); return (user + system) / 1e6; };
let build = Infinity, total = Infinity, areas = null;
for (let k = 0; k < repeat; k++) {
  const start = seconds();
  const delaunay = geoDelaunay(points);
  build = Math.min(build, seconds() - start);
  if (points.length <= 100000) {
    areas = Float64Array.from(delaunay.polygons, (polygon) =>
      geoArea({ type: "Polygon", coordinates: [[...polygon, polygon[0]].map((t) => delaunay.centers[t])] }));
    total = Math.min(total, seconds() - start);
  }
}
if (areas) writeFileSync(areasFile, areas);
console.log(build, areas ? total : "-", process.resourceUsage().maxRSS);
