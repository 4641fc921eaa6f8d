/* The vertex of a triangle mesh that is farthest from another, and the shortest path between them.
 *
 *     mesh SURFACE.off VERTEX
 *
 *     c++ -std=c++17 mesh.cpp -lheatpath
 */
#include "heatpath.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

struct Surface {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    explicit Surface(const std::string &name)
    {
        std::ifstream file(name);
        std::string magic;
        std::size_t vertices = 0, faces = 0, edges = 0;
        file >> magic >> vertices >> faces >> edges;
        if (!file || magic != "OFF")
            throw std::runtime_error(name + " is no OFF file");
        for (std::size_t i = 0; i < vertices && file; i++) {
            std::array<double, 3> p{};
            file >> p[0] >> p[1] >> p[2];
            points.push_back(p);
        }
        for (std::size_t i = 0, corners = 0; i < faces && file; i++) {
            std::array<std::uint32_t, 3> t{};
            file >> corners >> t[0] >> t[1] >> t[2];
            if (corners != 3)
                throw std::runtime_error(name + " has faces that are no triangles");
            triangles.push_back(t);
        }
        if (!file)
            throw std::runtime_error(name + " is too short");
    }
};

int main(int argc, char **argv)
try {
    if (argc != 3) {
        std::fprintf(stderr, "usage: mesh SURFACE.off VERTEX\n");
        return 2;
    }
    const Surface surface(argv[1]);
    const heatpath::Mesh mesh(surface.points, surface.triangles);
    const heatpath::MeshSolver solver(mesh);

    const std::array<long, 1> source{std::atol(argv[2])};
    const auto from = heatpath::SurfacePoints::vertices(source);
    const std::vector<double> distances = solver.distances(from);
    const auto nearer = [](double a, double b) { return !std::isfinite(b) ? false : a < b; };
    const auto far = std::max_element(distances.begin(), distances.end(), nearer);
    const std::array<long, 1> end{far - distances.begin()};
    std::printf("%ld %.17g\n", end[0], *far);

    const auto paths = solver.paths(from, heatpath::SurfacePoints::vertices(end));
    for (const auto &[x, y, z] : paths[0].points)
        std::printf("%.17g %.17g %.17g\n", x, y, z);
    return 0;
} catch (const std::exception &error) {
    std::fprintf(stderr, "mesh: %s\n", error.what());
    return 1;
}
