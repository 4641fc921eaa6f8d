// Eight threads at once, of which every other one cancels: each gets its own results and messages.
#include "heatpath.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr unsigned width = 40, height = 30;

std::atomic<int> failures{0};

void check(bool fine, const char *what)
{
    if (!fine) {
        std::printf("%s\n", what);
        ++failures;
    }
}

template <class T> hp_buffer describe(std::vector<T> &pixels, uint32_t type)
{
    hp_buffer buffer;
    check(hp_buffer_init(&buffer, sizeof buffer) == HP_OK, "init");
    buffer.data = pixels.data();
    buffer.type = type;
    buffer.size[0] = width;
    buffer.size[1] = height;
    return buffer;
}

std::vector<double> distances(const hp_buffer &image, uint32_t threads)
{
    std::vector<double> result(width * height, -1.0);
    hp_buffer target = describe(result, HP_F64);
    hp_options options;
    check(hp_options_init(&options, sizeof options) == HP_OK, "options");
    options.threads = threads;
    const std::array<double, 4> sources{5.0, 6.0, 33.25, 20.5};
    check(hp_distance(&image, nullptr, sources.data(), 2, &options, &target) == HP_OK, "distance");
    return result;
}

int cancel(double, void *calls)
{
    ++*static_cast<int *>(calls);
    return 1;
}

// Nothing is written, and nobody else is disturbed.
void cancelled(const hp_buffer &image, uint32_t threads)
{
    std::vector<double> result(width * height, -1.0);
    const std::vector<double> untouched = result;
    const hp_buffer target = describe(result, HP_F64);
    int calls = 0;
    hp_options options;
    check(hp_options_init(&options, sizeof options) == HP_OK, "options");
    options.threads = threads;
    options.progress = cancel;
    options.user = &calls;
    const double source[2] = {5, 6};
    const hp_status status = hp_distance(&image, nullptr, source, 1, &options, &target);
    check(status == HP_CANCELLED, "a cancelled call");
    check(calls == 1, "a call that goes on after it was cancelled");
    check(result == untouched, "the result of a cancelled call");
}

// The maps of two sources, by a solver that threads share.
std::vector<double> maps(const hp_solver *solver)
{
    std::vector<double> result(2 * width * height, -1.0);
    const hp_buffer first = describe(result, HP_F64);
    const std::array<double, 4> sources{5.0, 6.0, 33.25, 20.5};
    check(hp_solver_distances(solver, sources.data(), 2, nullptr, &first, 0) == HP_OK, "maps");
    return result;
}

struct Shared {
    const hp_paths *paths;
    const hp_solver *solver;
    std::vector<double> distances, maps;
};

void work(unsigned number, const hp_buffer &image, const Shared &shared)
{
    const double outside[2] = {-100.0 - number, 0.0};
    const std::string words = "[-10" + std::to_string(number) + ".0, 0.0]";
    for (int round = 0; round < 5; ++round) {
        if (number % 2 == 1)
            cancelled(image, 1 + number % 3);
        std::vector<double> unused(width * height);
        hp_buffer target = describe(unused, HP_F64);
        const hp_status status = hp_distance(&image, nullptr, outside, 1, nullptr, &target);
        check(status == HP_INVALID_POINT, "a source outside the image");
        check(distances(image, 1 + number % 3) == shared.distances, "distances of another thread");
        check(maps(shared.solver) == shared.maps, "maps of a shared solver");
        hp_path_info info{};
        info.struct_size = sizeof info;
        check(hp_paths_info(shared.paths, 0, &info) == HP_OK, "shared paths");
        check(info.ending == HP_ENDED_SOURCE, "the path reaches the source");
        const std::string message = hp_last_error_message();
        check(message.find(words) != std::string::npos, message.c_str());
    }
}

} // namespace

int main()
{
    std::vector<uint16_t> pixels;
    for (unsigned i = 0; i < width * height; ++i)
        pixels.push_back(static_cast<uint16_t>(30000.0 + 20000.0 * std::sin(0.2 * i)));
    const hp_buffer image = describe(pixels, HP_U16);
    const std::vector<double> expected = distances(image, 1);

    const double source[2] = {5, 6}, end[2] = {35, 25};
    hp_paths *paths = nullptr;
    check(hp_paths_create(&image, nullptr, source, 1, end, 1, nullptr, &paths) == HP_OK, "paths");
    hp_options options;
    check(hp_options_init(&options, sizeof options) == HP_OK, "options");
    options.solver = HP_SOLVER_IMPLICIT;
    options.reference = 0.5;
    hp_solver *solver = nullptr;
    check(hp_solver_create(&image, nullptr, &options, &solver) == HP_OK, "solver");
    const Shared shared{paths, solver, expected, maps(solver)};
    std::vector<std::thread> threads;
    for (unsigned number = 0; number < 8; ++number)
        threads.emplace_back(work, number, std::cref(image), std::cref(shared));
    for (std::thread &thread : threads)
        thread.join();
    check(std::string(hp_last_error_message()).empty(), "the message of another thread");
    hp_paths_free(paths);
    hp_solver_free(solver);
    return failures != 0;
}
