/* Wrong calls about meshes: each must fail in words, and none may crash. */
#include "mesh_check.h"

static hp_array xyz, corners;
static double values[VERTICES];

/* The mesh of these lists must be refused. */
static void refuse(int line, const hp_array *a, const hp_array *b, const hp_array *starts,
                   const hp_mesh_options *options, hp_status status, const char *words)
{
    hp_mesh *mesh = (hp_mesh *)values;
    expect(line, "mesh", hp_mesh_create(a, b, starts, options, &mesh), status, words);
    CHECK(mesh == NULL);
}

#define REFUSE(list, field, value, status, words)                                                  \
    do {                                                                                           \
        hp_array good = list;                                                                      \
        list.field = (value);                                                                      \
        refuse(__LINE__, &xyz, &corners, NULL, NULL, (status), (words));                           \
        list = good;                                                                               \
    } while (0)

static void wrong_lists(void)
{
    hp_mesh *mesh;
    hp_array odd = xyz;
    hp_array *shifted = (hp_array *)(void *)((char *)&odd + 1);
    refuse(__LINE__, NULL, &corners, NULL, NULL, HP_INVALID_ARGUMENT, "points is NULL");
    refuse(__LINE__, &xyz, NULL, NULL, NULL, HP_INVALID_ARGUMENT, "faces is NULL");
    refuse(__LINE__, shifted, &corners, NULL, NULL, HP_INVALID_ARGUMENT, "multiple of 8");
    EXPECT(HP_INVALID_ARGUMENT, "mesh is NULL", hp_mesh_create(&xyz, &corners, NULL, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "array is NULL", hp_array_init(NULL, sizeof xyz));
    EXPECT(HP_INVALID_ARGUMENT, "struct_size", hp_array_init(&odd, 8));
    REFUSE(xyz, struct_size, 0, HP_INVALID_ARGUMENT, "struct_size of hp_array is 0");
    REFUSE(xyz, type, 0, HP_INVALID_BUFFER, "points: type is 0");
    REFUSE(xyz, type, 11, HP_INVALID_BUFFER, "points: type is 11");
    REFUSE(xyz, data, NULL, HP_INVALID_BUFFER, "points: data is NULL");
    REFUSE(xyz, count, UINT64_MAX, HP_INVALID_BUFFER, "outside of all memory");
    REFUSE(xyz, count, (uint64_t)1 << 33, HP_INVALID_MESH, "at most 1431655765");
    REFUSE(xyz, count, 0, HP_INVALID_MESH, "there are 0");
    REFUSE(xyz, byte_stride, INT64_MIN, HP_INVALID_BUFFER, "outside of all memory");
    REFUSE(xyz, byte_stride, INT64_MAX, HP_INVALID_BUFFER, "outside of all memory");
    REFUSE(corners, type, HP_F32, HP_INVALID_BUFFER, "one of integers");
    REFUSE(corners, data, NULL, HP_INVALID_BUFFER, "faces: data is NULL");
    REFUSE(corners, count, 0, HP_INVALID_MESH, "no faces");
    REFUSE(corners, count, (uint64_t)1 << 33, HP_INVALID_MESH, "8589934592 faces");
    mesh = mesh_of(&xyz, &corners, NULL, NULL);
    hp_mesh_free(mesh);
    hp_mesh_free(NULL);
}

static void wrong_meshes(void)
{
    const int32_t negative[3] = {0, 1, -7};
    const int64_t large[6] = {0, 1, 2, 3, (int64_t)1 << 40, 4};
    const uint64_t huge[3] = {0, UINT64_MAX, 1};
    const uint32_t twice[3] = {5, 5, 6};
    const int32_t starts[4] = {0, 3, 2, 6}, beyond[3] = {0, 3, 9}, before[2] = {-3, 3};
    const hp_array three = array_of(negative, HP_I32, 1), six = array_of(large, HP_I64, 2);
    const hp_array one = array_of(huge, HP_U64, 1), same = array_of(twice, HP_U32, 1);
    const hp_array polygons = array_of(faces, HP_U32, 6);
    const hp_array back = array_of(starts, HP_I32, 4), far = array_of(beyond, HP_I32, 3);
    const hp_array below = array_of(before, HP_I32, 2), none = array_of(starts, HP_I32, 0);
    hp_mesh_options options = mesh_defaults();
    double *coordinate = &points[3][1];
    const double good = *coordinate;
    refuse(__LINE__, &xyz, &three, NULL, NULL, HP_INVALID_MESH, "face 0 uses vertex -7, but there are 258");
    refuse(__LINE__, &xyz, &six, NULL, NULL, HP_INVALID_MESH, "face 1 uses vertex 1099511627776");
    refuse(__LINE__, &xyz, &one, NULL, NULL, HP_INVALID_MESH, "vertex 18446744073709551615");
    refuse(__LINE__, &xyz, &same, NULL, NULL, HP_INVALID_MESH, "no faces");
    refuse(__LINE__, &xyz, &polygons, &back, NULL, HP_INVALID_MESH, "polygon 1 goes from 3 to 2");
    refuse(__LINE__, &xyz, &polygons, &far, NULL, HP_INVALID_MESH, "polygon 1 goes from 3 to 9");
    refuse(__LINE__, &xyz, &polygons, &below, NULL, HP_INVALID_MESH, "polygon 0 goes from -3");
    refuse(__LINE__, &xyz, &polygons, &none, NULL, HP_INVALID_MESH, "no faces");
    *coordinate = NAN;
    refuse(__LINE__, &xyz, &corners, NULL, NULL, HP_INVALID_MESH, "vertex 3 lies at");
    *coordinate = 1e200;
    refuse(__LINE__, &xyz, &corners, NULL, NULL, HP_INVALID_MESH, "vertex 3 lies at");
    *coordinate = good;
    options.weld = -1;
    refuse(__LINE__, &xyz, &corners, NULL, &options, HP_INVALID_ARGUMENT, "weld distance is -1");
    options.weld = INFINITY;
    refuse(__LINE__, &xyz, &corners, NULL, &options, HP_INVALID_ARGUMENT, "weld distance is inf");
    options.weld = 100;
    refuse(__LINE__, &xyz, &corners, NULL, &options, HP_INVALID_MESH, "no faces");
    options = mesh_defaults();
    options.reserved = 1;
    refuse(__LINE__, &xyz, &corners, NULL, &options, HP_INVALID_ARGUMENT, "reserved is 1");
    options.struct_size = 3;
    refuse(__LINE__, &xyz, &corners, NULL, &options, HP_INVALID_ARGUMENT, "struct_size");
    /* An older header: what it does not know has its default. */
    memset(&options, 0xff, sizeof options);
    options.struct_size = 8;
    options.threads = 1;
    hp_mesh_free(mesh_of(&xyz, &corners, NULL, &options));
}

static const hp_mesh *mesh;

static void refuse_solver(int line, const hp_mesh_options *options, hp_status status,
                          const char *words)
{
    hp_mesh_solver *solver = (hp_mesh_solver *)values;
    expect(line, "solver", hp_mesh_solver_create(mesh, options, &solver), status, words);
    CHECK(solver == NULL);
}

#define REFUSE_SOLVER(field, value, status, words)                                                 \
    do {                                                                                           \
        hp_mesh_options options = mesh_defaults();                                                 \
        options.values = &list;                                                                    \
        options.method = HP_MESH_HEAT;                                                             \
        options.field = (value);                                                                   \
        refuse_solver(__LINE__, &options, (status), (words));                                      \
    } while (0)

#define REFUSE_EXPLICIT(field, value, status, words)                                               \
    do {                                                                                           \
        hp_mesh_options options = mesh_defaults();                                                 \
        options.method = HP_MESH_EXPLICIT;                                                         \
        options.field = (value);                                                                   \
        refuse_solver(__LINE__, &options, (status), (words));                                      \
    } while (0)

#define REFUSE_MEDIUM(kind, field, value, status, words)                                           \
    do {                                                                                           \
        hp_mesh_options options = mesh_defaults();                                                 \
        options.medium = (kind);                                                                   \
        options.values = &list;                                                                    \
        options.method = HP_MESH_HEAT;                                                             \
        options.field = (value);                                                                   \
        refuse_solver(__LINE__, &options, (status), (words));                                      \
    } while (0)

static void wrong_solvers(void)
{
    const hp_array list = array_of(values, HP_F64, VERTICES);
    static double indefinite[FACES][6];
    const hp_array metric = array_of(indefinite, HP_F64, FACES);
    hp_mesh_solver *solver;
    int i;
    for (i = 0; i < VERTICES; i++)
        values[i] = i == 9 ? 0 : 1 + i % 3;
    EXPECT(HP_INVALID_ARGUMENT, "mesh is NULL", hp_mesh_solver_create(NULL, NULL, &solver));
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL", hp_mesh_solver_create(mesh, NULL, NULL));
    hp_mesh_solver_free(NULL);
    REFUSE_SOLVER(medium, 0, HP_INVALID_ARGUMENT, "medium is 0");
    REFUSE_SOLVER(medium, 8, HP_INVALID_ARGUMENT, "medium is 8");
    REFUSE_SOLVER(method, 5, HP_INVALID_ARGUMENT, "method is 5");
    REFUSE_SOLVER(threads, 1025, HP_INVALID_ARGUMENT, "threads is 1025");
    REFUSE_SOLVER(curvature, 2, HP_INVALID_ARGUMENT, "curvature is 2");
    REFUSE_SOLVER(farthest, -1, HP_INVALID_ARGUMENT, "farthest is -1");
    REFUSE_SOLVER(farthest, NAN, HP_INVALID_ARGUMENT, "farthest is NaN");
    REFUSE_SOLVER(time, -1, HP_INVALID_ARGUMENT, "time is -1");
    REFUSE_SOLVER(time, INFINITY, HP_INVALID_ARGUMENT, "time is inf");
    REFUSE_SOLVER(memory, 1, HP_OUT_OF_MEMORY, "of memory");
    REFUSE_EXPLICIT(step, 3, HP_UNSTABLE_STEP, "stable only up to");
    REFUSE_EXPLICIT(step, -1, HP_INVALID_ARGUMENT, "time step is -1");
    REFUSE_EXPLICIT(iterations, 1000000001, HP_INVALID_ARGUMENT, "number of iterations is");
    REFUSE_EXPLICIT(iterations, UINT64_MAX, HP_INVALID_ARGUMENT, "number of iterations is");
    REFUSE_MEDIUM(HP_MESH_SPEED_SQ, values, NULL, HP_INVALID_ARGUMENT, "values is NULL");
    REFUSE_MEDIUM(HP_MESH_METRIC, values, NULL, HP_INVALID_ARGUMENT, "values is NULL");
    REFUSE_MEDIUM(HP_MESH_SPEED_SQ, method, HP_MESH_HEAT, HP_INVALID_IMAGE, "squared speed is 0 at vertex 9");
    REFUSE_MEDIUM(HP_MESH_SLOWNESS, method, HP_MESH_HEAT, HP_INVALID_BUFFER, "258 values were given for 512");
    REFUSE_MEDIUM(HP_MESH_SPEED_SQ, values, &corners, HP_INVALID_BUFFER, "512 values were given for 258");
    REFUSE_MEDIUM(HP_MESH_METRIC, values, &metric, HP_INVALID_IMAGE, "metric of face 0");
    REFUSE_MEDIUM(HP_MESH_SCALARS, reference, NAN, HP_INVALID_ARGUMENT, "reference value is NaN");
    REFUSE_MEDIUM(HP_MESH_CURVATURE, bend, 3, HP_INVALID_ARGUMENT, "bend is 3");
    REFUSE_MEDIUM(HP_MESH_CURVATURE, floor, 0, HP_INVALID_ARGUMENT, "floor is 0");
    REFUSE_MEDIUM(HP_MESH_CREASE, power, -1, HP_INVALID_ARGUMENT, "power is -1");
    REFUSE_MEDIUM(HP_MESH_CREASE, quantile, 1.5, HP_INVALID_ARGUMENT, "quantile is 1.5");
    REFUSE_MEDIUM(HP_MESH_CREASE, radius, -2, HP_INVALID_ARGUMENT, "radius is -2");
    values[9] = 1;
    REFUSE_MEDIUM(HP_MESH_SPEED_SQ, method, HP_MESH_EXACT, HP_INVALID_ARGUMENT, "the same on all faces");
}

static hp_mesh_solver *solver;

/* The same wrong points as sources and as ends. */
static void refuse_points(int line, const hp_surface_points *wrong, hp_status status,
                          const char *words)
{
    const uint32_t vertex = 0;
    const hp_array number = array_of(&vertex, HP_U32, 1), target = array_of(values, HP_F64, VERTICES);
    const hp_surface_points right = at_vertices(&number);
    hp_paths *paths = (hp_paths *)values;
    expect(line, "distances",
           hp_mesh_solver_distances(solver, wrong, NULL, &target, 0, NULL, 0), status, words);
    expect(line, "sources", hp_mesh_paths_create(solver, wrong, &right, NULL, &paths), status, words);
    CHECK(paths == NULL);
    if (wrong && (wrong->curve || wrong->offsets || wrong->labels || wrong->sets)) {
        status = HP_INVALID_ARGUMENT;
        words = "are for sources";
    }
    expect(line, "ends", hp_mesh_paths_create(solver, &right, wrong, NULL, &paths), status,
           wrong ? words : "ends is NULL");
    expect(line, "way points", hp_mesh_paths_through(solver, wrong, NULL, &paths), status,
           wrong ? words : "points is NULL");
    CHECK(paths == NULL);
}

static void wrong_points(void)
{
    static const double far[3] = {0, INFINITY, 0}, outside[3] = {2, -1, 0}, half[3] = {0.5, 0.5, 0.5};
    const int64_t beyond[2] = {3, VERTICES}, below[1] = {-1}, none[2] = {2, FACES};
    const int32_t two[2] = {1, 2}, wrong_label[2] = {0, -1}, backwards[3] = {0, 2, 1};
    const int32_t empty[3] = {0, 0, 2}, each[3] = {0, 1, 2};
    const double nowhere[2] = {0, NAN};
    const hp_array numbers = array_of(beyond, HP_I64, 2), negative = array_of(below, HP_I64, 1);
    const hp_array good = array_of(two, HP_I32, 2), no_face = array_of(none, HP_I64, 2);
    const hp_array floats = array_of(far, HP_F64, 1), shares = array_of(outside, HP_F64, 1);
    const hp_array halves = array_of(half, HP_F64, 1), nothing = array_of(two, HP_I32, 0);
    const hp_array labels = array_of(wrong_label, HP_I32, 2), offsets = array_of(nowhere, HP_F64, 2);
    const hp_array few = array_of(two, HP_I32, 1), back = array_of(backwards, HP_I32, 3);
    const hp_array hollow = array_of(empty, HP_I32, 3), two_sets = array_of(each, HP_I32, 3);
    hp_surface_points places = surface_points();
    refuse_points(__LINE__, NULL, HP_INVALID_ARGUMENT, "sources is NULL");
    refuse_points(__LINE__, &places, HP_INVALID_ARGUMENT, "one of vertices, positions");
    places.vertices = places.positions = &good;
    refuse_points(__LINE__, &places, HP_INVALID_ARGUMENT, "one of vertices, positions");
    places = at_vertices(&numbers);
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "1 is vertex 258, but there are 258");
    places.vertices = &negative;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "0 is vertex -1");
    places.vertices = &nothing;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "at least one is needed");
    places.vertices = &floats;
    refuse_points(__LINE__, &places, HP_INVALID_BUFFER, "one of integers");
    places = surface_points();
    places.positions = &floats;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "it must be finite");
    places = surface_points();
    places.faces = &few;
    refuse_points(__LINE__, &places, HP_INVALID_ARGUMENT, "faces with weights");
    places.weights = &shares;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "weights [2.0, -1.0, 0.0]");
    places.weights = &halves;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "add up to 1");
    places.faces = &negative;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "face -1");
    places.faces = &good;
    refuse_points(__LINE__, &places, HP_INVALID_BUFFER, "1 items were given for 2 points");
    places = surface_points();
    places.faces = &no_face;
    places.weights = &halves;
    refuse_points(__LINE__, &places, HP_INVALID_BUFFER, "1 items were given for 2 points");

    places = at_vertices(&good);
    places.labels = &labels;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "label 1 is -1");
    places.labels = &few;
    refuse_points(__LINE__, &places, HP_INVALID_BUFFER, "labels: 1 items");
    places.labels = NULL;
    places.offsets = &offsets;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "offset 1 is NaN");
    places.offsets = &few;
    refuse_points(__LINE__, &places, HP_INVALID_BUFFER, "offsets: 1 items");
    places.offsets = NULL;
    places.curve = 1;
    refuse_points(__LINE__, &places, HP_INVALID_ARGUMENT, "a curve is made of positions");
    places.curve = 0;
    places.sets = &back;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "set 1 goes from 2 to 1");
    places.sets = &hollow;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "set 0 goes from 0 to 0");
    places.sets = &nothing;
    refuse_points(__LINE__, &places, HP_INVALID_POINT, "no sets");
    places.sets = &two_sets;
    {
        hp_paths *paths;
        const hp_surface_points ends = at_vertices(&good);
        EXPECT(HP_INVALID_ARGUMENT, "sets must be NULL",
               hp_mesh_paths_create(solver, &places, &ends, NULL, &paths));
        places = at_vertices(&few);
        EXPECT(HP_INVALID_ARGUMENT, "at least two",
               hp_mesh_paths_through(solver, &places, NULL, &paths));
    }
}

static void refuse_target(int line, const hp_array *distances, int64_t stride, const hp_array *labels,
                          int64_t label_stride, const char *words)
{
    const uint32_t two[2] = {0, 1}, starts[3] = {0, 1, 2};
    const hp_array numbers = array_of(two, HP_U32, 2), sets = array_of(starts, HP_U32, 3);
    hp_surface_points sources = at_vertices(&numbers);
    sources.sets = &sets;
    expect(line, "distances",
           hp_mesh_solver_distances(solver, &sources, NULL, distances, stride, labels, label_stride),
           HP_INVALID_BUFFER, words);
    if (!labels)
        expect(line, "matrix", hp_mesh_solver_matrix(solver, NULL, distances, stride),
               HP_INVALID_BUFFER, words);
}

static void wrong_targets(void)
{
    static double maps[2][VERTICES];
    static int32_t names[2][VERTICES];
    hp_array target = array_of(maps, HP_F64, VERTICES), labels = array_of(names, HP_I32, VERTICES);
    hp_array good = target;
    memset(maps, 0x55, sizeof maps);
    target.count--;
    refuse_target(__LINE__, &target, 0, NULL, 0, "distances: count is 257; it must be 258");
    target = array_of(maps, HP_U32, VERTICES);
    refuse_target(__LINE__, &target, 0, NULL, 0, "HP_F32 or HP_F64");
    target = good;
    refuse_target(__LINE__, &target, 8, NULL, 0, "overlap");
    refuse_target(__LINE__, &target, INT64_MAX, NULL, 0, "outside of all memory");
    refuse_target(__LINE__, &target, INT64_MIN, NULL, 0, "outside of all memory");
    target.byte_stride = 4;
    refuse_target(__LINE__, &target, 0, NULL, 0, "overlap");
    refuse_target(__LINE__, &good, 0, &labels, 4, "labels: a stride is 4");
    labels.type = HP_F32;
    refuse_target(__LINE__, &good, 0, &labels, 0, "labels: its type must be HP_I32");
    labels.type = HP_U8;
    refuse_target(__LINE__, &good, 0, &labels, 0, "labels: its type must be HP_I32");
    CHECK(((unsigned char *)maps)[0] == 0x55 && ((unsigned char *)maps)[sizeof maps - 1] == 0x55);
    EXPECT(HP_INVALID_ARGUMENT, "distances is NULL", hp_mesh_solver_matrix(solver, NULL, NULL, 0));
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL", hp_mesh_solver_matrix(NULL, NULL, &good, 0));
}

static void wrong_accessors(void)
{
    hp_mesh_report report;
    hp_array target = array_of(values, HP_F64, VERTICES), levels = array_of(values, HP_F64, 1);
    hp_array few = array_of(values, HP_F64, 7);
    hp_mesh_options options = mesh_defaults();
    hp_paths *paths;
    uint32_t method;
    report.struct_size = 4;
    EXPECT(HP_INVALID_ARGUMENT, "struct_size", hp_mesh_describe(mesh, &report));
    EXPECT(HP_INVALID_ARGUMENT, "report is NULL", hp_mesh_describe(mesh, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "mesh is NULL", hp_mesh_describe(NULL, &report));
    EXPECT(HP_INVALID_BUFFER, "HP_I32", hp_mesh_faces(mesh, &target));
    EXPECT(HP_INVALID_ARGUMENT, "faces is NULL", hp_mesh_faces(mesh, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "method is NULL", hp_mesh_solver_method(solver, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL", hp_mesh_solver_method(NULL, &method));
    EXPECT(HP_INVALID_BUFFER, "largest: count is 7",
           hp_mesh_curvature(mesh, NULL, &target, &few, NULL, NULL));
    options.radius = NAN;
    EXPECT(HP_INVALID_ARGUMENT, "radius is NaN",
           hp_mesh_curvature(mesh, &options, &target, NULL, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "values is NULL", hp_mesh_isolines_create(mesh, NULL, &levels, &paths));
    EXPECT(HP_INVALID_ARGUMENT, "levels is NULL", hp_mesh_isolines_create(mesh, &target, NULL, &paths));
    EXPECT(HP_INVALID_BUFFER, "7 values", hp_mesh_isolines_create(mesh, &few, &levels, &paths));
    values[3] = NAN;
    EXPECT(HP_INVALID_IMAGE, "vertex 3", hp_mesh_isolines_create(mesh, &target, &levels, &paths));
    values[3] = 1;
    values[0] = INFINITY;
    EXPECT(HP_INVALID_ARGUMENT, "level 0 is inf", hp_mesh_isolines_create(mesh, &target, &levels, &paths));
    CHECK(paths == NULL);
    values[0] = 1;
}

/* Two components: what is not reached is no failure. */
static void apart(void)
{
    static const double two[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    static const uint32_t both[2][3] = {{0, 1, 2}, {3, 4, 5}};
    static const uint32_t ends[2] = {4, 1}, source = 0;
    const hp_array vertices = array_of(two, HP_F64, 6), triangles = array_of(both, HP_U32, 2);
    const hp_array from = array_of(&source, HP_U32, 1), to = array_of(ends, HP_U32, 2);
    const hp_surface_points sources = at_vertices(&from), places = at_vertices(&to);
    hp_mesh_options options = mesh_defaults();
    hp_mesh *pair = mesh_of(&vertices, &triangles, NULL, NULL);
    uint32_t method;
    for (method = HP_MESH_AUTO; method <= HP_MESH_EXPLICIT; method++) {
        static const double farthest[2] = {0, 0.5};
        int i;
        for (i = 0; i < 2; i++) {
            hp_mesh_solver *own;
            hp_paths *paths;
            hp_path_info info;
            info.struct_size = sizeof info;
            options.method = method;
            options.farthest = farthest[i];
            options.shorten = 1;
            own = solver_of(pair, &options);
            EXPECT(HP_OK, "", hp_mesh_paths_create(own, &sources, &places, &options, &paths));
            EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
            CHECK(info.ending == HP_ENDED_UNREACHABLE && info.source == -1);
            CHECK(info.point_count == 1 && info.length == 0 && isinf(info.distance));
            EXPECT(HP_OK, "", hp_paths_info(paths, 1, &info));
            CHECK(info.ending == (i ? HP_ENDED_NOT_REACHED : HP_ENDED_SOURCE));
            CHECK(isinf(info.distance) == (i == 1));
            hp_paths_free(paths);
            EXPECT(HP_OK, "", hp_mesh_paths_through(own, &places, &options, &paths));
            EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
            CHECK(info.ending == HP_ENDED_UNREACHABLE && info.source == -1);
            CHECK(isinf(info.distance) && info.point_count == 1);
            hp_paths_free(paths);
            hp_mesh_solver_free(own);
        }
    }
    hp_mesh_free(pair);
}

/* Heat begins everywhere at once. */
static void explicit_heat_has_no_offsets(void)
{
    const uint32_t vertex = 3;
    const double later = 0.5;
    const hp_array number = array_of(&vertex, HP_U32, 1), offset = array_of(&later, HP_F64, 1);
    const hp_array result = array_of(values, HP_F64, VERTICES);
    hp_surface_points sources = at_vertices(&number);
    hp_mesh_options options = mesh_defaults();
    hp_mesh_solver *own;
    options.method = HP_MESH_EXPLICIT;
    options.step = 0;
    options.iterations = 40;
    own = solver_of(mesh, &options);
    EXPECT(HP_OK, "", hp_mesh_solver_distances(own, &sources, NULL, &result, 0, NULL, 0));
    sources.offsets = &offset;
    EXPECT(HP_INVALID_ARGUMENT, "source offset is 0.5; it must be 0",
           hp_mesh_solver_distances(own, &sources, NULL, &result, 0, NULL, 0));
    hp_mesh_solver_free(own);
}

struct watcher {
    int calls, stop_at;
    double last;
};

static int watch(double finished, void *user)
{
    struct watcher *watcher = user;
    CHECK(finished >= watcher->last && finished <= 1);
    watcher->last = finished;
    return ++watcher->calls == watcher->stop_at;
}

enum { CREATE, PREPARE, DISTANCES, MATRIX, PATHS, THROUGH, CURVATURE, CALLS };

static hp_status call(int which, const hp_mesh_options *options)
{
    static double matrix[VERTICES][VERTICES];
    const uint32_t three[3] = {0, 1, 2}, starts[3] = {0, 1, 3};
    const hp_array numbers = array_of(three, HP_U32, 3), sets = array_of(starts, HP_U32, 3);
    const hp_array target = array_of(matrix, HP_F64, VERTICES);
    hp_surface_points sources = at_vertices(&numbers), ends = sources;
    hp_mesh *other = NULL;
    hp_mesh_solver *made = NULL;
    hp_paths *paths = NULL;
    hp_status status;
    switch (which) {
    case CREATE:
        status = hp_mesh_create(&xyz, &corners, NULL, options, &other);
        break;
    case PREPARE:
        status = hp_mesh_solver_create(mesh, options, &made);
        break;
    case DISTANCES:
        sources.sets = &sets;
        status = hp_mesh_solver_distances(solver, &sources, options, &target, 0, NULL, 0);
        break;
    case MATRIX:
        status = hp_mesh_solver_matrix(solver, options, &target, 0);
        break;
    case PATHS:
        status = hp_mesh_paths_create(solver, &sources, &ends, options, &paths);
        break;
    case THROUGH:
        status = hp_mesh_paths_through(solver, &ends, options, &paths);
        break;
    default:
        status = hp_mesh_curvature(mesh, options, &target, NULL, NULL, NULL);
    }
    CHECK((other || made || paths) == (status == HP_OK && which != DISTANCES && which != MATRIX && which != CURVATURE));
    hp_mesh_free(other);
    hp_mesh_solver_free(made);
    hp_paths_free(paths);
    return status;
}

/* Every question of the callback can be answered with the end of the call. */
static void cancelling(uint32_t medium)
{
    int which, stop_at;
    for (which = 0; which < CALLS; which++) {
        hp_mesh_options options = mesh_defaults();
        struct watcher watcher = {0, 0, 0};
        int all;
        options.medium = medium;
        options.method = HP_MESH_HEAT;
        options.progress = watch;
        options.user = &watcher;
        EXPECT(HP_OK, "", call(which, &options));
        CHECK(watcher.last == 1 && watcher.calls >= 1);
        all = watcher.calls;
        for (stop_at = 1; stop_at <= all; stop_at += 1 + all / 8) {
            watcher.calls = 0;
            watcher.last = 0;
            watcher.stop_at = stop_at;
            EXPECT(HP_CANCELLED, "progress callback", call(which, &options));
            CHECK(watcher.calls == stop_at);
        }
    }
}

int main(void)
{
    hp_mesh *made;
    make_sphere();
    xyz = array_of(points, HP_F64, VERTICES);
    corners = array_of(faces, HP_U32, FACES);
    wrong_lists();
    wrong_meshes();
    mesh = made = sphere();
    wrong_solvers();
    explicit_heat_has_no_offsets();
    {
        hp_mesh_options options = mesh_defaults();
        options.method = HP_MESH_HEAT;
        solver = solver_of(mesh, &options);
    }
    wrong_points();
    wrong_targets();
    wrong_accessors();
    apart();
    cancelling(HP_MESH_UNIFORM);
    cancelling(HP_MESH_CURVATURE);
    {
        /* Only on the surface as it is are the shortest paths the nearest. */
        hp_mesh_options options = mesh_defaults();
        hp_surface_points places = surface_points();
        hp_mesh_solver *bent;
        hp_paths *paths;
        options.medium = HP_MESH_CURVATURE;
        options.shorten = 1;
        bent = solver_of(mesh, &options);
        EXPECT(HP_INVALID_ARGUMENT, "shorten is for HP_MESH_UNIFORM",
               hp_mesh_paths_create(bent, &places, &places, &options, &paths));
        hp_mesh_solver_free(bent);
    }
    hp_mesh_solver_free(solver);
    hp_mesh_free(made);
    return failures != 0;
}
