/* The minimal path between two points of a picture, as lines of x y.
 *
 *     path PICTURE.pgm X Y END_X END_Y
 *
 *     c++ -std=c++17 path.cpp -lheatpath
 */
#include "heatpath.hpp"
#include "pgm.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char **argv)
try {
    if (argc != 6) {
        std::fprintf(stderr, "usage: path PICTURE.pgm X Y END_X END_Y\n");
        return 2;
    }
    const Pgm picture(argv[1]);
    const heatpath::Buffer image(picture.pixels.data(), {picture.width, picture.height});
    const auto number = [argv](int i) { return std::atof(argv[i]); };

    const auto paths = heatpath::paths<2>(image, {{number(2), number(3)}}, {{number(4), number(5)}});
    for (const auto &[x, y] : paths[0].points)
        std::printf("%.17g %.17g\n", x, y);
    return paths[0].arrived() ? 0 : 5;
} catch (const std::exception &error) {
    std::fprintf(stderr, "path: %s\n", error.what());
    return 1;
}
