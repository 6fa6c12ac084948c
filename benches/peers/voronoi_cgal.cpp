// CGAL's Delaunay_triangulation_on_sphere_2; solid angles of the cells by fans of its circumcentres, in doubles, for CGAL
// has none. A fourth argument is the number of sets of sites in the file, each triangulated in turn: times are sums, and there
// are no cells then. Called by voronoi.sh.
#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_on_sphere_traits_3.h>
#include <CGAL/Triangulation_on_sphere_face_base_2.h>
#include <CGAL/Triangulation_on_sphere_vertex_base_2.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <sys/resource.h>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// The traits that take points near the sphere as they are: the faster ones.
using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
using Triangulation = CGAL::Delaunay_triangulation_on_sphere_2<Traits>;
using Point = Traits::Point_3;
using Vector = Kernel::Vector_3;

static double seconds() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static Vector unit(const Vector& v) { return v / std::sqrt(v.squared_length()); }

static double triangle(const Vector& a, const Vector& b, const Vector& c) {
    return 2 * std::atan2(a * CGAL::cross_product(b, c), 1 + a * b + b * c + c * a);
}

// The least seconds of `repeat` rounds through all sets.
static double least_of_rounds(const std::vector<Point>& points, std::size_t sets, int repeat) {
    double least = std::numeric_limits<double>::infinity();
    const std::size_t size = points.size() / sets;
    for (; repeat > 0; --repeat) {
        double sum = 0;
        for (std::size_t set = 0; set < sets; ++set) {
            std::vector<Point> copy(points.begin() + set * size, points.begin() + (set + 1) * size);
            double start = seconds();
            Triangulation triangulation(copy.begin(), copy.end(), Traits(Point(0, 0, 0), 1));
            sum += seconds() - start;
        }
        least = std::min(least, sum);
    }
    return least;
}

int main(int count, char** argv) {
    std::vector<Point> points;
    FILE* file = std::fopen(argv[1], "rb");
    for (double p[3]; std::fread(p, sizeof p, 1, file) == 1;) points.emplace_back(p[0], p[1], p[2]);
    std::fclose(file);

    if (count > 4) {
        std::printf("%.9g - -\n", least_of_rounds(points, std::atoi(argv[4]), std::atoi(argv[3])));
        return 0;
    }

    double build = std::numeric_limits<double>::infinity(), total = build;
    std::vector<double> areas;
    for (int k = std::atoi(argv[3]); k > 0; --k) {
        std::vector<Point> copy = points;
        double start = seconds();
        Triangulation triangulation(copy.begin(), copy.end(), Traits(Point(0, 0, 0), 1));
        build = std::min(build, seconds() - start);
        if (triangulation.dimension() < 2) continue;
        areas.assign(points.size(), 0);
        std::vector<std::pair<Point, double>> found;
        for (auto vertex : triangulation.vertex_handles()) {
            const Point& site = vertex->point();
            auto face = triangulation.incident_faces(vertex), end = face;
            std::vector<Vector> corners;
            do {
                const Point &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
                corners.push_back(unit(CGAL::cross_product(b - a, c - a)));
            } while (++face != end);
            double area = 0;
            for (std::size_t i = 0; i < corners.size(); ++i)
                area += triangle(site - CGAL::ORIGIN, corners[i], corners[(i + 1) % corners.size()]);
            found.emplace_back(site, area);
        }
        total = std::min(total, seconds() - start);
        if (found.size() == points.size()) {
            std::vector<std::size_t> order(points.size());
            for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
            std::sort(order.begin(), order.end(), [&](auto i, auto j) { return points[i] < points[j]; });
            std::sort(found.begin(), found.end(), [&](auto& p, auto& q) { return p.first < q.first; });
            for (std::size_t i = 0; i < order.size(); ++i) areas[order[i]] = found[i].second;
        } else {
            areas.clear(); // sites were merged: no cell for some
        }
    }
    if (!areas.empty()) {
        file = std::fopen(argv[2], "wb");
        std::fwrite(areas.data(), sizeof(double), areas.size(), file);
        std::fclose(file);
    }
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    if (std::isfinite(total)) std::printf("%.9g %.9g %ld\n", build, total, usage.ru_maxrss);
    else std::printf("%.9g - %ld\n", build, usage.ru_maxrss);
}
