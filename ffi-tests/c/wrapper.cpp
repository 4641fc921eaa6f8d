// heatpath.hpp: what it owns is freed, what fails is thrown, and results are those of the C functions.
#include "check.h"
#include "heatpath.hpp"

#include <string>

static unsigned char pixels[PIXELS];
static const heatpath::Points<2> from{{4, 5}}, to{{20, 15}};

static heatpath::Buffer picture()
{
    return heatpath::Buffer(pixels, {WIDTH, HEIGHT});
}

static void results_are_those_of_c()
{
    hp_buffer image = buffer_of(pixels, HP_U8);
    double expected[PIXELS];
    hp_buffer target = buffer_of(expected, HP_F64);
    EXPECT(HP_OK, "", hp_distance(&image, nullptr, from[0].data(), 1, nullptr, &target));
    const std::vector<double> distances = heatpath::distance(picture(), from);
    CHECK(distances.size() == PIXELS);
    CHECK(memcmp(distances.data(), expected, sizeof expected) == 0);

    const auto paths = heatpath::paths(picture(), from, to);
    CHECK(paths.size() == 1 && paths[0].arrived());
    CHECK(paths[0].points.front() == to[0] && paths[0].points.back() == from[0]);

    std::vector<double> speed(PIXELS);
    heatpath::medium(picture(), from, heatpath::Buffer(speed.data(), {WIDTH, HEIGHT}));
    CHECK(fabs(speed[5 * WIDTH + 4] - 1.001) < 1e-12);

    heatpath::Options tubes;
    tubes.medium = HP_MEDIUM_VESSELNESS;
    const auto scales = heatpath::tube_scales(picture(), tubes);
    CHECK(!scales.empty() && scales.front() >= 1 && scales.back() <= HEIGHT / 8.0);
    double found[HP_MOST_TUBE_SCALES];
    uint64_t count = 0;
    EXPECT(HP_OK, "", hp_tube_scales(&image, nullptr, &tubes, found, &count));
    CHECK(scales == std::vector<double>(found, found + count));
}

static void solvers_move()
{
    heatpath::Options options;
    options.medium = HP_MEDIUM_UNIFORM;
    options.solver = HP_SOLVER_IMPLICIT;
    heatpath::Solver first(picture(), options);
    const heatpath::Solver solver = std::move(first);
    std::vector<double> maps(2 * PIXELS);
    const heatpath::Points<2> sources{{4, 5}, {10, 9}};
    solver.distances(sources, heatpath::Buffer(maps.data(), {WIDTH, HEIGHT}));
    CHECK(fabs(maps[9 * WIDTH + 10] - maps[PIXELS + 5 * WIDTH + 4]) < 0.1);
    CHECK(solver.paths(from, to)[0].arrived());
}

static void graphs_are_values()
{
    heatpath::Options options;
    options.medium = HP_MEDIUM_GIVEN;
    std::vector<float> speed(PIXELS, 1e-3f);
    for (int i = 0; i < HEIGHT; i++)
        speed[i * WIDTH + i] = speed[i * WIDTH + i + 1] = 1;
    const heatpath::Buffer band(speed.data(), {WIDTH, HEIGHT});
    heatpath::KeyPointOptions how;
    how.radius = 5;
    const auto tree = heatpath::key_points<2>(band, {{0, 0}}, options, how);
    CHECK(tree.nodes.size() > 2 && tree.branches.size() == tree.nodes.size() - 1);
    CHECK(tree.sources == heatpath::Points<2>({{0, 0}}));

    std::vector<float> votes_of(PIXELS);
    heatpath::VoteMaps maps;
    maps.density = heatpath::Buffer(votes_of.data(), {WIDTH, HEIGHT});
    const auto voted = heatpath::votes<2>(band, {{0, 0}}, options, {}, maps);
    CHECK(voted.info.physical_length > 10 && votes_of[5 * WIDTH + 5] > 0);

    std::vector<heatpath::Points<2>> lines;
    for (const auto &branch : voted.branches)
        lines.push_back(branch.points);
    const heatpath::Curves found(lines, {1, 1});
    const std::vector<heatpath::Points<2>> middle{{{0.5, 0}, {HEIGHT - 0.5, HEIGHT - 1}}};
    const heatpath::Curves truth(middle, {1, 1});
    const hp_score score = heatpath::evaluate(found, truth, 1.5);
    CHECK(score.precision > 0.9 && score.recall > 0.5);

    std::vector<unsigned char> bar(PIXELS);
    for (int x = 3; x < 20; x++)
        bar[9 * WIDTH + x] = 1;
    const heatpath::Buffer mask(bar.data(), {WIDTH, HEIGHT});
    CHECK(heatpath::skeleton<2>(mask).branches.size() == 1);
    CHECK(heatpath::evaluate(heatpath::Curves(mask), heatpath::Curves(mask), 0).f1 == 1);
}

static void failures_are_thrown()
{
    try {
        heatpath::distance<2>(picture(), {{-9, 0}});
        CHECK(!"a point outside is refused");
    } catch (const heatpath::Error &error) {
        CHECK(error.status() == HP_INVALID_POINT && std::string(error.name()) == "HP_INVALID_POINT");
        CHECK(strstr(error.what(), "source 0 at [-9.0, 0.0]"));
    }
    try {
        heatpath::distance<3>(picture(), {{1, 2, 3}});
        CHECK(!"points of a volume are refused");
    } catch (const std::invalid_argument &error) {
        CHECK(strstr(error.what(), "points have 3 coordinates, but the image has 2 axes"));
    }
    std::vector<double> speed(PIXELS);
    try {
        heatpath::medium<3>(picture(), {{1, 2, 3}}, heatpath::Buffer(speed.data(), {WIDTH, HEIGHT}));
        CHECK(!"points of a volume are refused here too");
    } catch (const std::invalid_argument &error) {
        CHECK(strstr(error.what(), "3 coordinates"));
    }
    try {
        heatpath::Buffer nothing;
        nothing.type = HP_U8;
        heatpath::distance(picture(), from, {}, nothing);
        CHECK(!"an empty mask is no mask that is left out");
    } catch (const heatpath::Error &error) {
        CHECK(error.status() == HP_INVALID_BUFFER);
    }
    heatpath::Options options;
    options.on_progress = [](double) { return false; };
    try {
        heatpath::distance(picture(), from, options);
        CHECK(!"false cancels");
    } catch (const heatpath::Error &error) {
        CHECK(error.status() == HP_CANCELLED);
    }
    options.on_progress = [](double) -> bool { throw std::string("thrown on"); };
    try {
        heatpath::votes<2>(picture(), from, options);
        CHECK(!"what the callback throws is thrown on");
    } catch (const std::string &thrown) {
        CHECK(thrown == "thrown on");
    }
}

static void many_points()
{
    heatpath::Options options;
    options.medium = HP_MEDIUM_UNIFORM;
    const heatpath::Solver solver(picture(), options);
    const heatpath::Points<2> sources{{4, 8}, {19, 8}};
    std::vector<std::int32_t> labels(PIXELS);
    std::vector<double> shares(2 * PIXELS), density(PIXELS);
    heatpath::NearestMaps maps;
    maps.labels = heatpath::Buffer(labels.data(), {WIDTH, HEIGHT});
    maps.shares = heatpath::Buffer(shares.data(), {WIDTH, HEIGHT});
    solver.nearest(sources, maps);
    CHECK(labels[3 * WIDTH + 2] == 0 && labels[3 * WIDTH + 20] == 1);
    CHECK(fabs(shares[8 * WIDTH + 4] + shares[PIXELS + 8 * WIDTH + 4] - 1) < 1e-12);
    const std::vector<double> row = solver.matrix(from, sources);
    CHECK(row.size() == 2 && fabs(row[0] - 3) < 0.5 && row[1] > 12);
    solver.bridge<2>({sources[0]}, {sources[1]}, heatpath::Buffer(density.data(), {WIDTH, HEIGHT}));
    CHECK(density[8 * WIDTH + 11] > density[2 * WIDTH + 11]);
}

/* More numbers than there are would be read. */
template <class Call>
static void refuses(const char *words, Call call)
{
    try {
        call();
        CHECK(!"items of another width are refused");
    } catch (const std::invalid_argument &error) {
        CHECK(strstr(error.what(), words));
    }
}

static void widths()
{
    const std::vector<double> flat{0, 0, 0, 3, 0, 0, 3, 4, 0};
    const std::vector<heatpath::Point<3>> points{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
    const std::vector<std::array<int, 3>> faces{{0, 1, 2}};
    const std::vector<int> corners{0, 1, 2};
    refuses("points need 3 numbers an item, but there are 1", [&] { heatpath::Mesh(flat, faces); });
    refuses("faces need 3", [&] { heatpath::Mesh(points, corners); });
    refuses("positions need 3", [&] { heatpath::SurfacePoints::positions(flat); });
    refuses("vertices need 1", [&] { heatpath::SurfacePoints::vertices(faces); });
    CHECK(heatpath::Mesh(heatpath::Array(flat.data(), 3), faces).report().vertices == 3);
}

static void places_on_meshes(const heatpath::Mesh &mesh, const heatpath::MeshSolver &solver)
{
    const std::vector<heatpath::Point<3>> above{{1, 1, 1}, {2, 3, 1}};
    const heatpath::Places places = mesh.locate(heatpath::SurfacePoints::positions(above), 2);
    CHECK(places.faces.size() == 2 && places.weights[0][0] > 0);
    const heatpath::SurfacePath path = solver.through(places.points());
    CHECK(path.arrived() && fabs(path.info.length - std::sqrt(5.0)) < 1e-9);
    CHECK(path.places.faces.size() == path.points.size());
    const std::vector<double> heights{0, 0, 4, 4}, levels{1};
    const auto lines = mesh.isolines(heights, levels);
    CHECK(lines.size() == 1 && lines[0].info.ending == HP_ENDED_OPEN);
    const std::array<int, 3> triangle{0, 1, 2};
    CHECK(mesh.loop(heatpath::SurfacePoints::vertices(triangle)).empty());
    CHECK(mesh.faces()[1][2] == 3 && mesh.curvature().largest.size() == 4);
    const std::vector<double> matrix = solver.matrix();
    CHECK(matrix.size() == 16 && fabs(matrix[2] - 5) < 1e-12);
    const std::array<int, 2> sources{0, 2}, called{7, 9};
    std::vector<double> distances(4);
    std::vector<int> labels(4);
    auto both = heatpath::SurfacePoints::vertices(sources);
    solver.distances(both.labels(called), distances, {}, labels);
    CHECK(labels[0] == 7 && labels[2] == 9 && distances[1] == 3);
}

static void meshes()
{
    const std::vector<heatpath::Point<3>> points{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}};
    const std::vector<std::array<unsigned short, 3>> faces{{0, 1, 2}, {0, 2, 3}};
    const heatpath::Mesh mesh(points, faces);
    CHECK(mesh.report().faces == 2 && mesh.report().border_edges == 4);
    const heatpath::MeshSolver solver(mesh);
    const std::array<int, 1> source{0}, end{2};
    const auto start = heatpath::SurfacePoints::vertices(source);
    CHECK(fabs(solver.distances(start)[2] - 5) < 1e-12);
    const auto paths = solver.paths(start, heatpath::SurfacePoints::vertices(end));
    CHECK(paths[0].arrived() && fabs(paths[0].info.length - 5) < 1e-9);
    const std::vector<heatpath::Point<3>> above{{3, 0, 1}};
    CHECK(fabs(solver.distances(heatpath::SurfacePoints::positions(above))[0] - 3) < 1e-12);
    places_on_meshes(mesh, solver);
    const std::array<int, 8> corners{0, 1, 2, 3};
    const std::array<int, 2> starts{0, 4};
    const heatpath::Mesh square(points, heatpath::Array(corners.data(), 4), starts);
    CHECK(square.report().polygons == 1 && square.report().faces == 2);
}

int main()
{
    for (int i = 0; i < PIXELS; i++)
        pixels[i] = static_cast<unsigned char>(255 * grey(i % WIDTH, i / WIDTH));
    results_are_those_of_c();
    solvers_move();
    graphs_are_values();
    failures_are_thrown();
    many_points();
    widths();
    meshes();
    return failures != 0;
}
