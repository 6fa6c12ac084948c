#!/usr/bin/env bash
# voronoi.sh install DIR           installs the other programs below DIR from their registries; says which it cannot have
# voronoi.sh run DIR PEER SITES AREAS REPEAT [SETS]
#     SITES: doubles x y z of each site, little-endian; AREAS: is filled with the solid angle of each cell, or not at all.
#     Prints the least CPU seconds of REPEAT triangulations, the same with cells and areas (or a dash), and the peak kB.
#     SETS (CGAL): so many sets of sites are in the file, all triangulated one after another; their time together, no areas.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$2"
dir=$(cd "$2" && pwd)

install() { # install PEER COMMAND...
    local peer=$1
    shift
    if [ -e "$dir/$peer.ready" ]; then return; fi
    if "$@" >"$dir/$peer.log" 2>&1; then touch "$dir/$peer.ready"; else echo "skipped: $peer cannot be had here, see $dir/$peer.log"; fi
}
python_peer() { # python_peer MODULE PACKAGE...: an environment of its own, for one of them needs an old numpy
    local module=$1
    shift
    python3 -m venv "$dir/$module" && "$dir/$module/bin/pip" install --quiet "$@" && "$dir/$module/bin/python" -c "import $module"
}
cgal() { g++ -O2 -DNDEBUG -std=c++17 "$here/voronoi_cgal.cpp" -o "$dir/voronoi_cgal" -lgmp -lmpfr; }
d3() { npm install --silent --no-audit --no-fund --prefix "$dir/d3" d3-geo-voronoi@2 d3-geo@3 && cp "$here/voronoi_d3.mjs" "$dir/d3/"; }

case $1 in
install)
    install scipy python_peer scipy "scipy>=1.11" numpy
    install stripy python_peer stripy stripy "numpy<2"
    install cgal cgal
    install d3 d3
    ;;
run)
    peer=$3
    [ -e "$dir/$peer.ready" ] || exit 3
    export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
    case $peer in
    scipy | stripy) "$dir/$peer/bin/python" "$here/voronoi_$peer.py" "${@:4}" ;;
    cgal) "$dir/voronoi_cgal" "${@:4}" ;;
    d3) node --max-old-space-size=8192 "$dir/d3/voronoi_d3.mjs" "${@:4}" ;;
    *) exit 2 ;;
    esac
    ;;
esac
