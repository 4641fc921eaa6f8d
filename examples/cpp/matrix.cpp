/* All distances between some points of a picture: the medium is factored once, and threads share it.
 *
 *     matrix PICTURE.pgm REFERENCE X Y [X Y ...]
 *
 *     c++ -std=c++17 matrix.cpp -lheatpath
 */
#include "heatpath.hpp"
#include "pgm.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

/* The pixel of a coordinate, which runs from half a pixel before the first to half a pixel after the last. */
static std::size_t nearest(double at, std::size_t size)
{
    return std::min(static_cast<std::size_t>(std::max(at + 0.5, 0.0)), size - 1);
}

int main(int argc, char **argv)
try {
    if (argc < 5 || argc % 2 == 0) {
        std::fprintf(stderr, "usage: matrix PICTURE.pgm REFERENCE X Y [X Y ...]\n");
        return 2;
    }
    const Pgm picture(argv[1]);
    const heatpath::Buffer image(picture.pixels.data(), {picture.width, picture.height});
    heatpath::Points<2> points;
    for (int i = 3; i < argc; i += 2)
        points.push_back({std::atof(argv[i]), std::atof(argv[i + 1])});

    heatpath::Options options;
    options.solver = HP_SOLVER_IMPLICIT;
    options.reference = std::atof(argv[2]); /* the grey value, 0 to 1, of what the paths follow */
    const heatpath::Solver solver(image, options);
    std::vector<double> maps(points.size() * image.pixels());
    solver.distances(points, heatpath::Buffer(maps.data(), {picture.width, picture.height}));

    for (std::size_t from = 0; from < points.size(); from++) {
        for (const auto &[x, y] : points) {
            const std::size_t column = nearest(x, picture.width), row = nearest(y, picture.height);
            std::printf("%.17g ", maps[(from * picture.height + row) * picture.width + column]);
        }
        std::printf("\n");
    }
    return 0;
} catch (const std::exception &error) {
    std::fprintf(stderr, "matrix: %s\n", error.what());
    return 1;
}
