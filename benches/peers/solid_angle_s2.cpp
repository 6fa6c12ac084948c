// Signed areas of loops by s2geometry, and what each costs.
//
// In: the number of rounds, then one loop a line: n x y z x y z …
// Out: nanoseconds per loop (the fastest of the rounds), then the area of every loop.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "s2/s2loop_measures.h"
#include "s2/s2measures.h"
#include "s2/s2point.h"
#include "s2/s2point_span.h"

static double area(const std::vector<S2Point>& loop) {
  return loop.size() == 3 ? S2::SignedArea(loop[0], loop[1], loop[2]) : S2::GetSignedArea(S2PointLoopSpan(loop));
}

int main() {
  int rounds, n;
  if (std::scanf("%d", &rounds) != 1) return EXIT_FAILURE;
  std::vector<std::vector<S2Point>> loops;
  while (std::scanf("%d", &n) == 1) {
    std::vector<S2Point> loop;
    for (int i = 0; i < n; ++i) {
      double x, y, z;
      if (std::scanf("%lf %lf %lf", &x, &y, &z) != 3) return EXIT_FAILURE;
      loop.emplace_back(x, y, z);
    }
    loops.push_back(std::move(loop));
  }
  double best = std::numeric_limits<double>::infinity();
  volatile double sink = 0;
  for (int round = 0; round < rounds; ++round) {
    auto start = std::chrono::steady_clock::now();
    double sum = 0;
    for (const auto& loop : loops) sum += area(loop);
    std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
    sink = sum;
    best = std::min(best, spent.count() / loops.size());
  }
  std::printf("%.17g\n", best);
  for (const auto& loop : loops) std::printf("%.17g\n", area(loop));
}
