/* Distances and paths on a sphere, against the closed form. */
#include "mesh_check.h"

/* The mean and the largest error of distances from vertex 0, relative. */
static void check_errors(const double *distances, double factor, double mean, double largest)
{
    double sum = 0, most = 0;
    uint32_t i;
    CHECK(distances[0] == 0);
    for (i = 1; i < VERTICES; i++) {
        const double error = fabs(distances[i] / (factor * angle(0, i)) - 1);
        sum += error;
        most = error > most ? error : most;
    }
    if (!(sum / (VERTICES - 1) <= mean && most <= largest)) {
        printf("errors: mean %g, largest %g\n", sum / (VERTICES - 1), most);
        failures++;
    }
}

/* Each method, and the solver outlives the mesh. */
static void methods(void)
{
    static const double mean[5] = {0.01, 0.01, 0.015, 0.01, 0.08};
    static const double largest[5] = {0.03, 0.03, 0.03, 0.03, 0.2};
    double distances[VERTICES];
    uint32_t method;
    for (method = HP_MESH_AUTO; method <= HP_MESH_EXPLICIT; method++) {
        hp_mesh_options options = mesh_defaults();
        hp_mesh *mesh = sphere();
        hp_mesh_solver *solver;
        uint32_t chosen = 99;
        options.method = method;
        solver = solver_of(mesh, &options);
        hp_mesh_free(mesh);
        EXPECT(HP_OK, "", hp_mesh_solver_method(solver, &chosen));
        CHECK(chosen == (method == HP_MESH_AUTO ? HP_MESH_EXACT : method));
        distances_from(solver, 0, distances, VERTICES);
        check_errors(distances, 1, mean[method], largest[method]);
        hp_mesh_solver_free(solver);
    }
}

/* Every medium that makes ways longer or shorter by a factor. */
static void media(void)
{
    static double speed_sq[VERTICES], scalars[VERTICES], slowness[FACES], metric[FACES][6];
    const struct {
        uint32_t medium;
        hp_array values;
        double factor;
    } cases[] = {
        {HP_MESH_SPEED_SQ, array_of(speed_sq, HP_F64, VERTICES), 0.5},
        {HP_MESH_SLOWNESS, array_of(slowness, HP_F64, FACES), 3},
        {HP_MESH_METRIC, array_of(metric, HP_F64, FACES), 2},
        {HP_MESH_SCALARS, array_of(scalars, HP_F64, VERTICES), 1 / sqrt(1.001)},
    };
    hp_mesh *mesh = sphere();
    double distances[VERTICES];
    size_t i;
    for (i = 0; i < VERTICES; i++) {
        speed_sq[i] = 4;
        scalars[i] = 0.25;
    }
    for (i = 0; i < FACES; i++) {
        slowness[i] = 3;
        metric[i][0] = metric[i][3] = metric[i][5] = 4;
    }
    for (i = 0; i < sizeof cases / sizeof *cases; i++) {
        hp_mesh_options options = mesh_defaults();
        hp_mesh_solver *solver;
        options.medium = cases[i].medium;
        options.values = &cases[i].values;
        options.reference = 0.25;
        solver = solver_of(mesh, &options);
        distances_from(solver, 0, distances, VERTICES);
        check_errors(distances, cases[i].factor, 0.01, 0.03);
        hp_mesh_solver_free(solver);
    }
    hp_mesh_free(mesh);
}

/* A sheet folded into a roof: along the ridge ways are short, in both media of curvature. */
static void ridges(void)
{
    enum { SIDE = 21, CELLS = (SIDE - 1) * (SIDE - 1) };
    static double roof[SIDE * SIDE][3], distances[SIDE * SIDE];
    static uint16_t squares[CELLS][4];
    static int32_t starts[CELLS + 1];
    const hp_array xyz = array_of(roof, HP_F64, SIDE * SIDE);
    const hp_array corners = array_of(squares, HP_U16, 4 * CELLS);
    const hp_array offsets = array_of(starts, HP_I32, CELLS + 1);
    const uint32_t ridge = SIDE / 2;
    uint32_t medium, i;
    hp_mesh *mesh;
    for (i = 0; i < SIDE * SIDE; i++) {
        roof[i][0] = i % SIDE;
        roof[i][1] = i / SIDE;
        roof[i][2] = -fabs((double)(i % SIDE) - ridge);
    }
    for (i = 0; i < CELLS; i++) {
        const uint16_t first = (uint16_t)(i / (SIDE - 1) * SIDE + i % (SIDE - 1));
        squares[i][0] = first, squares[i][1] = first + 1;
        squares[i][2] = first + 1 + SIDE, squares[i][3] = first + SIDE;
        starts[i + 1] = 4 * (int32_t)(i + 1);
    }
    mesh = mesh_of(&xyz, &corners, &offsets, NULL);
    for (medium = HP_MESH_CURVATURE; medium <= HP_MESH_CREASE; medium++) {
        hp_mesh_options options = mesh_defaults();
        hp_mesh_solver *solver;
        options.medium = medium;
        options.method = HP_MESH_EIKONAL;
        options.bend = HP_BEND_CONVEX;
        options.radius = 2;
        options.floor = 0.04;
        solver = solver_of(mesh, &options);
        distances_from(solver, ridge, distances, SIDE * SIDE);
        /* Twenty rows along the ridge, and ten columns of length sqrt(2) across it at a fifth. */
        CHECK(distances[ridge + 20 * SIDE] > 19 && distances[ridge + 20 * SIDE] < 35);
        CHECK(distances[0] > 50 && distances[0] < 75);
        hp_mesh_solver_free(solver);
    }
    hp_mesh_free(mesh);
}

/* All ways to name the same sources give the same distances. */
static void ways_to_name_points(void)
{
    double by_vertex[VERTICES], others[VERTICES];
    const uint32_t face = 100, corner = faces[100][1];
    const double weights[3] = {0, 1, 0};
    const hp_array numbers = array_of(&face, HP_U32, 1), shares = array_of(weights, HP_F64, 1);
    const hp_array position = array_of(points[corner], HP_F64, 1);
    const hp_array target = array_of(others, HP_F64, VERTICES);
    hp_surface_points places = surface_points();
    hp_mesh *mesh = sphere();
    hp_mesh_solver *solver = solver_of(mesh, NULL);
    distances_from(solver, corner, by_vertex, VERTICES);
    places.faces = &numbers;
    places.weights = &shares;
    EXPECT(HP_OK, "", hp_mesh_solver_distances(solver, &places, NULL, &target, 0, NULL, 0));
    CHECK(memcmp(others, by_vertex, sizeof others) == 0);
    places = surface_points();
    places.positions = &position;
    EXPECT(HP_OK, "", hp_mesh_solver_distances(solver, &places, NULL, &target, 0, NULL, 0));
    CHECK(memcmp(others, by_vertex, sizeof others) == 0);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

/* The equator as a curve: the distance is the latitude. Heat rounds off the two places that lie
 * farthest from all of it. */
static void curves(uint32_t method, double most)
{
    enum { POINTS = 65 };
    static double equator[POINTS][3], distances[VERTICES];
    static int32_t labels[VERTICES];
    const hp_array positions = array_of(equator, HP_F64, POINTS);
    const hp_array target = array_of(distances, HP_F64, VERTICES);
    const hp_array names = array_of(labels, HP_I32, VERTICES);
    hp_surface_points curve = surface_points();
    hp_mesh_options options = mesh_defaults();
    hp_mesh *mesh = sphere();
    hp_mesh_solver *solver;
    uint32_t i;
    options.method = method;
    solver = solver_of(mesh, &options);
    for (i = 0; i < POINTS; i++) {
        equator[i][0] = cos(i * 2 * acos(-1.0) / (POINTS - 1));
        equator[i][1] = sin(i * 2 * acos(-1.0) / (POINTS - 1));
    }
    curve.positions = &positions;
    curve.curve = 1;
    EXPECT(HP_OK, "", hp_mesh_solver_distances(solver, &curve, NULL, &target, 0, &names, 0));
    for (i = 0; i < VERTICES; i++)
        CHECK(labels[i] == 0 && fabs(distances[i] - fabs(asin(points[i][2]))) < most);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

static hp_path_info info_of(const hp_paths *paths, uint64_t index)
{
    hp_path_info info;
    info.struct_size = sizeof info;
    EXPECT(HP_OK, "", hp_paths_info(paths, index, &info));
    return info;
}

/* The first and the last point must be these vertices, and the polyline as long as it says. */
static void check_polyline(const hp_paths *paths, uint64_t index, uint32_t from, uint32_t to)
{
    const hp_path_info info = info_of(paths, index);
    double(*line)[3] = malloc((size_t)info.point_count * sizeof *line), length = 0;
    uint64_t i;
    int axis;
    EXPECT(HP_OK, "", hp_paths_points(paths, index, line[0], info.point_count));
    for (i = 1; i < info.point_count; i++)
        length += sqrt(pow(line[i][0] - line[i - 1][0], 2) + pow(line[i][1] - line[i - 1][1], 2)
                       + pow(line[i][2] - line[i - 1][2], 2));
    CHECK(fabs(length - info.length) < 1e-12 && info.length == info.physical_length);
    for (axis = 0; axis < 3; axis++) {
        CHECK(line[0][axis] == points[from][axis]);
        CHECK(line[info.point_count - 1][axis] == points[to][axis]);
    }
    free(line);
}

static void paths(uint32_t method, uint32_t shorten)
{
    const uint32_t from[2] = {1, 77}, to[2] = {40, 0};
    const int64_t labels[2] = {7, 2147483647};
    const hp_array sources = array_of(to, HP_U32, 2), ends = array_of(from, HP_U32, 2);
    const hp_array names = array_of(labels, HP_I64, 2);
    hp_surface_points source = at_vertices(&sources), end = at_vertices(&ends);
    hp_mesh_options options = mesh_defaults();
    hp_mesh *mesh = sphere();
    hp_mesh_solver *solver;
    hp_paths *found = NULL;
    uint64_t count = 0, i;
    options.method = method;
    options.shorten = shorten;
    solver = solver_of(mesh, &options);
    source.labels = &names;
    EXPECT(HP_OK, "", hp_mesh_paths_create(solver, &source, &end, &options, &found));
    EXPECT(HP_OK, "", hp_paths_count(found, &count));
    CHECK(count == 2);
    for (i = 0; i < 2; i++) {
        const hp_path_info info = info_of(found, i);
        const int nearest = angle(from[i], to[0]) < angle(from[i], to[1]) ? 0 : 1;
        const double exact = angle(from[i], to[nearest]);
        CHECK(info.ending == HP_ENDED_SOURCE && info.source == labels[nearest]);
        CHECK(fabs(info.distance - exact) < 0.03 * exact);
        CHECK(info.length > 0.98 * exact && info.length < (shorten ? 1.001 : 1.02) * exact);
        check_polyline(found, i, from[i], to[nearest]);
        if (method == HP_MESH_EXACT)
            CHECK(fabs(info.length - info.distance) < 1e-9);
    }
    hp_paths_free(found);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

/* Through the north pole, with each piece straight. */
static void way_points(void)
{
    const uint32_t way[4] = {0, 4, 1, 3};
    const hp_array numbers = array_of(way, HP_U32, 4);
    const hp_surface_points through = at_vertices(&numbers);
    hp_mesh_options options = mesh_defaults();
    hp_mesh *mesh = sphere();
    hp_mesh_solver *solver = solver_of(mesh, NULL);
    hp_paths *found = NULL;
    hp_path_info info;
    options.shorten = 1;
    EXPECT(HP_OK, "", hp_mesh_paths_through(solver, &through, &options, &found));
    info = info_of(found, 0);
    CHECK(info.ending == HP_ENDED_SOURCE && info.source == 3);
    CHECK(fabs(info.length / (1.5 * acos(-1.0)) - 1) < 0.01);
    CHECK(fabs(info.distance / info.length - 1) < 0.03);
    check_polyline(found, 0, 0, 3);
    hp_paths_free(found);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

/* The parallels of the sphere. */
static void parallels(void)
{
    const double heights[3] = {-0.5, 0.3, 7};
    const hp_array levels = array_of(heights, HP_F64, 3);
    hp_array values = array_of(&points[0][2], HP_F64, VERTICES);
    hp_mesh *mesh = sphere();
    hp_paths *found = NULL;
    uint64_t count = 0, i;
    values.byte_stride = sizeof points[0];
    EXPECT(HP_OK, "", hp_mesh_isolines_create(mesh, &values, &levels, &found));
    EXPECT(HP_OK, "", hp_paths_count(found, &count));
    CHECK(count == 2);
    for (i = 0; i < 2; i++) {
        const hp_path_info info = info_of(found, i);
        const double exact = 2 * acos(-1.0) * sqrt(1 - heights[i] * heights[i]);
        CHECK(info.ending == HP_ENDED_CLOSED && info.source == (int64_t)i);
        CHECK(info.distance == heights[i] && fabs(info.length / exact - 1) < 0.02);
    }
    hp_paths_free(found);
    hp_mesh_free(mesh);
}

static void curvature(void)
{
    static float smallest[VERTICES], largest[VERTICES], directions[VERTICES][3];
    hp_mesh *mesh = sphere();
    hp_mesh_options options = mesh_defaults();
    const hp_array low = array_of(smallest, HP_F32, VERTICES);
    const hp_array high = array_of(largest, HP_F32, VERTICES);
    const hp_array along = array_of(directions, HP_F32, VERTICES);
    uint32_t method, i;
    for (method = HP_CURVATURE_NORMAL_CYCLES; method <= HP_CURVATURE_LEAST_SQUARES; method++) {
        options.curvature = method;
        EXPECT(HP_OK, "", hp_mesh_curvature(mesh, &options, &low, &high, NULL, &along));
        for (i = 0; i < VERTICES; i++) {
            const float *d = directions[i];
            const double across = d[0] * points[i][0] + d[1] * points[i][1] + d[2] * points[i][2];
            CHECK(smallest[i] <= largest[i]);
            CHECK(fabs(smallest[i] - 1) < 0.15 && fabs(largest[i] - 1) < 0.15);
            CHECK(fabs(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1) < 1e-5 && fabs(across) < 0.1);
        }
    }
    hp_mesh_free(mesh);
}

int main(void)
{
    uint32_t method;
    make_sphere();
    methods();
    media();
    ridges();
    ways_to_name_points();
    curves(HP_MESH_HEAT, 0.06);
    curves(HP_MESH_EXACT, 0.02);
    for (method = HP_MESH_AUTO; method <= HP_MESH_EXACT; method++) {
        paths(method, 0);
        paths(method, 1);
    }
    way_points();
    parallels();
    curvature();
    return failures != 0;
}
