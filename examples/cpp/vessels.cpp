/* The dark vessels of a picture, found without a click, as lines "from to length radius".
 *
 *     vessels PICTURE.pgm
 *
 *     c++ -std=c++17 vessels.cpp -lheatpath
 */
#include "heatpath.hpp"
#include "pgm.hpp"

#include <cstdio>

int main(int argc, char **argv)
try {
    if (argc != 2) {
        std::fprintf(stderr, "usage: vessels PICTURE.pgm\n");
        return 2;
    }
    const Pgm picture(argv[1]);
    const heatpath::Buffer image(picture.pixels.data(), {picture.width, picture.height});

    heatpath::Options options;
    options.medium = HP_MEDIUM_VESSELNESS;
    options.polarity = HP_POLARITY_DARK;
    options.on_progress = [](double finished) {
        std::fprintf(stderr, "\r%3.0f %%", 100 * finished);
        return true; /* false would cancel */
    };
    const heatpath::Graph<2> tree = heatpath::votes<2>(image, {}, options);
    std::fprintf(stderr, "\n");
    for (const auto &branch : tree.branches)
        std::printf("%llu %llu %.17g %.17g\n", static_cast<unsigned long long>(branch.info.from),
                    static_cast<unsigned long long>(branch.info.to), branch.info.physical_length,
                    branch.info.mean_radius);
    return 0;
} catch (const std::exception &error) {
    std::fprintf(stderr, "vessels: %s\n", error.what());
    return 1;
}
