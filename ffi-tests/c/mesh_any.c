/* Random triangles, sources and options: any call may fail, but never as a mistake of the library, and
 * results are numbers. With heat and fast marching; takes the number of rounds. */
#include "mesh_check.h"

enum { POINTS = 14, TRIANGLES = 18, MOST_FACES = 3 * TRIANGLES, SETS = 2 };

static uint64_t state = 1;

/* From 0 to below `end`. */
static uint32_t any(uint32_t end)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 33) % end;
}

/* A call that may fail. */
static int works(int line, hp_status status)
{
    if (status == HP_PANIC)
        complain(line, "panic", hp_last_error_message());
    return status == HP_OK;
}

#define WORKS(call) works(__LINE__, (call))

static int32_t numbers[2 * SETS];
static double weights[2 * SETS][3];

/* Vertices, places in space or places on faces, sometimes of none. */
static hp_surface_points any_places(hp_array *lists)
{
    hp_surface_points places = surface_points();
    uint32_t i, kind = any(3);
    for (i = 0; i < 2 * SETS; i++) {
        const double part = any(5) / 4.0;
        numbers[i] = (int32_t)any(kind == 0 ? POINTS : TRIANGLES) - !any(40);
        weights[i][0] = kind == 2 ? part : any(9);
        weights[i][1] = kind == 2 ? (1 - part) * 0.5 : any(9);
        weights[i][2] = kind == 2 ? (1 - part) * 0.5 : any(9);
    }
    lists[0] = array_of(numbers, HP_I32, 2 * SETS);
    lists[1] = array_of(weights, HP_F64, 2 * SETS);
    if (kind == 0)
        places.vertices = &lists[0];
    else if (kind == 1)
        places.positions = &lists[1];
    else
        places.faces = &lists[0], places.weights = &lists[1];
    places.curve = kind == 1 && any(2);
    return places;
}

static void check_maps(double maps[][POINTS], int32_t labels[][POINTS], uint32_t sets)
{
    uint32_t set, i;
    for (set = 0; set < sets; set++)
        for (i = 0; i < POINTS; i++) {
            CHECK(maps[set][i] >= 0);
            CHECK((labels[set][i] == -1) == !!isinf(maps[set][i]));
            CHECK(labels[set][i] >= -1 && labels[set][i] < 2 * SETS);
        }
}

static void check_paths(hp_paths *paths)
{
    double line[1000][3];
    uint64_t count, i, k;
    EXPECT(HP_OK, "", hp_paths_count(paths, &count));
    for (i = 0; i < count; i++) {
        hp_path_info info;
        info.struct_size = sizeof info;
        EXPECT(HP_OK, "", hp_paths_info(paths, i, &info));
        CHECK(info.length >= 0 && info.distance >= 0 && info.point_count >= 1);
        EXPECT(HP_OK, "", hp_paths_points(paths, i, line[0], 1000));
        for (k = 0; k < info.point_count; k++)
            CHECK(line[k][0] - line[k][0] == 0 && fabs(line[k][2]) < 10);
    }
    hp_paths_free(paths);
}

/* Everything that can be asked of a mesh. */
static void ask(const hp_mesh *mesh, hp_array values)
{
    static const int32_t starts[SETS + 1] = {0, 2, 4};
    static double maps[SETS][POINTS], matrix[POINTS][POINTS];
    static int32_t labels[SETS][POINTS];
    const hp_array sets = array_of(starts, HP_I32, SETS + 1), levels = array_of(values.data, HP_F64, 2);
    const hp_array target = array_of(maps, HP_F64, POINTS), names = array_of(labels, HP_I32, POINTS);
    const hp_array all = array_of(matrix, HP_F64, POINTS);
    hp_array lists[2];
    hp_mesh_options options = mesh_defaults();
    hp_mesh_solver *solver;
    hp_surface_points places, ends;
    hp_paths *paths;
    options.medium = HP_MESH_UNIFORM + (any(2) ? 0 : any(HP_MESH_CREASE));
    options.method = any(2) ? HP_MESH_HEAT : HP_MESH_EIKONAL;
    options.values = &values;
    options.reference = 0.5;
    options.farthest = any(4) ? 0 : 1 + any(3);
    options.shorten = any(2);
    options.curvature = any(2);
    options.radius = any(2) ? 0 : 1.5;
    if (WORKS(hp_mesh_isolines_create(mesh, &values, &levels, &paths)))
        check_paths(paths);
    if (options.medium == HP_MESH_SLOWNESS || options.medium == HP_MESH_METRIC) {
        hp_mesh_report report;
        report.struct_size = sizeof report;
        EXPECT(HP_OK, "", hp_mesh_describe(mesh, &report));
        values.count = report.faces;
    }
    WORKS(hp_mesh_curvature(mesh, &options, &target, NULL, NULL, NULL));
    if (!WORKS(hp_mesh_solver_create(mesh, &options, &solver)))
        return;
    places = ends = any_places(lists);
    ends.curve = 0;
    if (WORKS(hp_mesh_paths_create(solver, &places, &ends, &options, &paths)))
        check_paths(paths);
    if (WORKS(hp_mesh_paths_through(solver, &ends, &options, &paths)))
        check_paths(paths);
    places.sets = places.curve ? NULL : &sets;
    if (WORKS(hp_mesh_solver_distances(solver, &places, &options, &target, 0, &names, 0)))
        check_maps(maps, labels, places.curve ? 1 : SETS);
    if (!any(4))
        EXPECT(HP_OK, "", hp_mesh_solver_matrix(solver, &options, &all, 0));
    hp_mesh_solver_free(solver);
}

int main(int count, char **arguments)
{
    static double xyz[POINTS][3], values[6 * MOST_FACES];
    static int32_t corners[3 * TRIANGLES], starts[TRIANGLES + 1];
    int rounds = count > 1 ? atoi(arguments[1]) : 100, made = 0;
    for (state = 1; rounds-- > 0;) {
        const hp_array vertices = array_of(xyz, HP_F64, POINTS);
        const hp_array list = array_of(values, HP_F64, POINTS);
        const int polygons = !any(4);
        const hp_array indices = array_of(corners, HP_I32, polygons ? 3 * TRIANGLES : TRIANGLES);
        const hp_array offsets = array_of(starts, HP_I32, TRIANGLES + 1);
        const uint32_t spread = 2 + any(6);
        hp_mesh_options options = mesh_defaults();
        hp_mesh *mesh;
        uint32_t i;
        for (i = 0; i < POINTS; i++) {
            xyz[i][0] = any(spread);
            xyz[i][1] = any(spread) + (any(3) ? 0 : 1e-9 * any(3));
            xyz[i][2] = any(2) ? 0 : any(spread);
        }
        for (i = 0; i < 3 * TRIANGLES; i++)
            corners[i] = (int32_t)any(any(9) ? POINTS / 2 : POINTS);
        for (i = 0; i < TRIANGLES; i++)
            starts[i + 1] = starts[i] + (int32_t)any(7);
        for (i = 0; i < 6 * MOST_FACES; i++)
            values[i] = 0.1 + any(10) + (i % 6 == 0 || i % 6 == 3 || i % 6 == 5 ? 20 : 0);
        options.weld = any(3) ? NAN : 0.5 * any(3);
        if (WORKS(hp_mesh_create(&vertices, &indices, polygons ? &offsets : NULL, &options, &mesh))) {
            made++;
            ask(mesh, list);
            hp_mesh_free(mesh);
        }
    }
    CHECK(made > 10);
    return failures != 0;
}
