// Four threads share a mesh and a solver: each gets its own results and its own messages.
#include "heatpath.h"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr unsigned side = 30;

std::atomic<int> failures{0};

void check(bool fine, const char *what)
{
    if (!fine) {
        std::printf("%s: %s\n", what, hp_last_error_message());
        ++failures;
    }
}

template <class T> hp_array describe(std::vector<T> &numbers, uint32_t type, std::size_t per_item = 1)
{
    hp_array array;
    check(hp_array_init(&array, sizeof array) == HP_OK, "array");
    array.type = type;
    array.data = numbers.data();
    array.count = numbers.size() / per_item;
    return array;
}

hp_surface_points at_vertices(const hp_array &numbers)
{
    hp_surface_points places;
    check(hp_surface_points_init(&places, sizeof places) == HP_OK, "points");
    places.vertices = &numbers;
    return places;
}

// A sheet of squares with a hill.
hp_mesh *make_mesh()
{
    std::vector<float> points;
    std::vector<int64_t> corners, starts{0};
    for (unsigned i = 0; i < side * side; ++i) {
        const float x = static_cast<float>(i % side), y = static_cast<float>(i / side);
        points.insert(points.end(), {x, y, 4.0f * std::sin(0.1f * x) * std::sin(0.1f * y)});
    }
    for (int64_t row = 0; row + 1 < side; ++row)
        for (int64_t first = row * side; first + 1 < (row + 1) * side; ++first) {
            corners.insert(corners.end(), {first, first + 1, first + side + 1, first + side});
            starts.push_back(static_cast<int64_t>(corners.size()));
        }
    const hp_array xyz = describe(points, HP_F32, 3), faces = describe(corners, HP_I64);
    const hp_array offsets = describe(starts, HP_I64);
    hp_mesh *mesh = nullptr;
    check(hp_mesh_create(&xyz, &faces, &offsets, nullptr, &mesh) == HP_OK, "mesh");
    return mesh;
}

std::vector<double> maps(const hp_mesh_solver *solver, uint32_t threads)
{
    std::vector<uint32_t> vertices{7, 100, 555}, starts{0, 1, 3};
    std::vector<double> result(2 * side * side, -1.0);
    const hp_array numbers = describe(vertices, HP_U32), sets = describe(starts, HP_U32);
    const hp_array target = describe(result, HP_F64, 2);
    hp_surface_points sources = at_vertices(numbers);
    sources.sets = &sets;
    hp_mesh_options options;
    check(hp_mesh_options_init(&options, sizeof options) == HP_OK, "options");
    options.threads = threads;
    const hp_status status =
        hp_mesh_solver_distances(solver, &sources, &options, &target, 0, nullptr, 0);
    check(status == HP_OK, "distances");
    return result;
}

std::vector<double> path(const hp_mesh_solver *solver)
{
    std::vector<uint32_t> from{7}, to{side * side - 1};
    const hp_array first = describe(from, HP_U32), last = describe(to, HP_U32);
    const hp_surface_points sources = at_vertices(first), ends = at_vertices(last);
    hp_paths *paths = nullptr;
    check(hp_mesh_paths_create(solver, &sources, &ends, nullptr, &paths) == HP_OK, "paths");
    hp_path_info info{};
    info.struct_size = sizeof info;
    check(hp_paths_info(paths, 0, &info) == HP_OK, "info");
    check(info.ending == HP_ENDED_SOURCE, "the path reaches the source");
    std::vector<double> result(3 * info.point_count);
    check(hp_paths_points(paths, 0, result.data(), info.point_count) == HP_OK, "path");
    hp_paths_free(paths);
    return result;
}

struct Shared {
    const hp_mesh *mesh;
    const hp_mesh_solver *solver;
    std::vector<double> maps, path;
};

void work(unsigned number, const Shared &shared)
{
    std::vector<uint32_t> wrong{10000 + number};
    const hp_array numbers = describe(wrong, HP_U32);
    const hp_surface_points nowhere = at_vertices(numbers);
    const std::string words = "vertex 1000" + std::to_string(number);
    for (int round = 0; round < 5; ++round) {
        hp_paths *none = nullptr;
        const hp_status status =
            hp_mesh_paths_create(shared.solver, &nowhere, &nowhere, nullptr, &none);
        check(status == HP_INVALID_POINT && none == nullptr, "a source that does not exist");
        check(maps(shared.solver, 1 + number % 3) == shared.maps, "maps of another thread");
        check(path(shared.solver) == shared.path, "the path of another thread");
        hp_mesh_solver *own = nullptr;
        check(hp_mesh_solver_create(shared.mesh, nullptr, &own) == HP_OK, "a solver of its own");
        hp_mesh_solver_free(own);
        const std::string message = hp_last_error_message();
        check(message.find(words) != std::string::npos, words.c_str());
    }
}

} // namespace

int main()
{
    hp_mesh *mesh = make_mesh();
    hp_mesh_solver *solver = nullptr;
    check(hp_mesh_solver_create(mesh, nullptr, &solver) == HP_OK, "solver");
    const Shared shared{mesh, solver, maps(solver, 1), path(solver)};
    std::vector<std::thread> threads;
    for (unsigned number = 0; number < 4; ++number)
        threads.emplace_back(work, number, std::cref(shared));
    for (std::thread &thread : threads)
        thread.join();
    check(std::string(hp_last_error_message()).empty(), "the message of another thread");
    hp_mesh_free(mesh);
    hp_mesh_solver_free(solver);
    return failures != 0;
}
