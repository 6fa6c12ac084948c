#!/usr/bin/env bash
# solid_angle_s2.sh DIR: builds the comparison with s2geometry in DIR and prints the path of the program.
#
# Takes the C++ headers and libraries inside the wheel that PyPI has (0.14, whose triangles are measured by StableAngle where
# they are skinny), else Debian's libs2-dev (0.10). Fails with a message where neither can be had.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
dir=${1:?the directory to build in}
mkdir -p "$dir"
program=$dir/solid_angle_s2
source=$here/solid_angle_s2.cpp
flags=(-O2 -DNDEBUG -march=x86-64)

if python3 -m pip install --quiet --no-deps --target "$dir/wheel" --upgrade 's2geometry==0.14.*' >&2; then
  wheel=$dir/wheel/s2geometry
  libraries=("$wheel"/lib*/*.a)
  if g++ -std=c++17 "${flags[@]}" -I"$wheel/include" "$source" -Wl,--start-group "${libraries[@]}" -Wl,--end-group \
      -lcrypto -lssl -lpthread -o "$program" 2>"$dir/wheel.log"; then
    echo "s2geometry 0.14 from PyPI" >&2
    echo "$program"
    exit
  fi
  tail -n 3 "$dir/wheel.log" >&2
fi
if g++ -std=c++17 "${flags[@]}" "$source" -ls2 -o "$program" 2>"$dir/debian.log"; then
  echo "s2geometry of the system" >&2
  echo "$program"
  exit
fi
tail -n 3 "$dir/debian.log" >&2
echo "no s2geometry: neither the wheel of PyPI nor libs2-dev can be compiled against" >&2
exit 1
