/* One prepared medium, many sources: the maps are those of hp_distance(), and misuse fails in words. */
#include "check.h"

enum { SOURCES = 3, DEPTH = 5 };

static double image_data[PIXELS * DEPTH], mask_data[PIXELS * DEPTH];
static double expected[SOURCES][PIXELS], maps[SOURCES][PIXELS];
static hp_buffer image, mask, first;
static const double sources[2 * SOURCES] = {3, 4, 20, 15, 7.25, 9.5};

static hp_options with(uint32_t solver)
{
    hp_options options = defaults();
    options.solver = solver;
    options.reference = 0.75;
    return options;
}

static hp_solver *made(const hp_options *options)
{
    hp_solver *solver = NULL;
    EXPECT(HP_OK, "", hp_solver_create(&image, &mask, options, &solver));
    CHECK(solver != NULL);
    return solver;
}

/* All maps at once are those made one by one, with any threads and estimator. */
static void maps_of(uint32_t kind, uint32_t estimator)
{
    hp_options options = with(kind);
    hp_solver *solver;
    uint32_t threads;
    int i;
    options.estimator = estimator;
    solver = made(&options);
    for (i = 0; i < SOURCES; i++) {
        hp_buffer one = buffer_of(expected[i], HP_F64);
        EXPECT(HP_OK, "", hp_distance(&image, &mask, sources + 2 * i, 1, &options, &one));
    }
    for (threads = 1; threads <= 3; threads++) {
        options.threads = threads;
        memset(maps, 0, sizeof maps);
        EXPECT(HP_OK, "", hp_solver_distances(solver, sources, SOURCES, &options, &first, 0));
        CHECK(memcmp(maps, expected, sizeof maps) == 0);
    }
    CHECK(expected[0][0] > 0 && expected[0][PIXELS - 1] > 10);
    hp_solver_free(solver);
}

/* Floats, with a gap between rows and maps, the last map first. */
static void maps_with_gaps(void)
{
    static float wide[SOURCES][HEIGHT + 2][WIDTH + 3];
    hp_options options = with(HP_SOLVER_IMPLICIT);
    hp_solver *solver = made(&options);
    hp_buffer target = buffer_of(wide[SOURCES - 1], HP_F32);
    int i, x, y;
    target.byte_stride[1] = sizeof wide[0][0];
    EXPECT(HP_OK, "", hp_solver_distances(solver, sources, SOURCES, NULL, &first, 0));
    EXPECT(HP_OK, "", hp_solver_distances(solver, sources, SOURCES, NULL, &target,
                                          -(int64_t)sizeof wide[0]));
    for (i = 0; i < SOURCES; i++)
        for (y = 0; y < HEIGHT + 2; y++)
            for (x = 0; x < WIDTH + 3; x++) {
                const int inside = x < WIDTH && y < HEIGHT;
                const float right = inside ? (float)maps[i][y * WIDTH + x] : 0;
                CHECK(wide[SOURCES - 1 - i][y][x] == right);
            }
    hp_solver_free(solver);
}

static void volumes(void)
{
    static double cube[2][PIXELS * DEPTH];
    const double points[6] = {3, 4, 2, 20, 15, 1.5};
    hp_options options = with(HP_SOLVER_IMPLICIT);
    hp_buffer volume = buffer_of(image_data, HP_F64), target = buffer_of(cube, HP_F64);
    hp_solver *solver;
    int i;
    options.medium = HP_MEDIUM_UNIFORM;
    volume.dimension = target.dimension = 3;
    volume.size[2] = target.size[2] = DEPTH;
    EXPECT(HP_OK, "", hp_solver_create(&volume, NULL, &options, &solver));
    EXPECT(HP_OK, "", hp_solver_distances(solver, points, 2, NULL, &target, 0));
    for (i = 0; i < 2; i++) {
        static double one[PIXELS * DEPTH];
        hp_buffer alone = target;
        alone.data = one;
        EXPECT(HP_OK, "", hp_distance(&volume, NULL, points + 3 * i, 1, &options, &alone));
        CHECK(memcmp(one, cube[i], sizeof one) == 0);
    }
    EXPECT(HP_INVALID_BUFFER, "dimension is 2",
           hp_solver_distances(solver, points, 2, NULL, &first, 0));
    hp_solver_free(solver);
}

static void paths_of_implicit_heat(void)
{
    hp_options options = with(HP_SOLVER_IMPLICIT);
    hp_paths *paths;
    hp_path_info info;
    info.struct_size = sizeof info;
    EXPECT(HP_OK, "", hp_paths_create(&image, &mask, sources, 1, sources + 2, 1, &options, &paths));
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    CHECK(info.ending == HP_ENDED_SOURCE && info.length > 20 && info.length < 30);
    hp_paths_free(paths);
}

/* A solver is for heat or for exact distances, and knows it. */
static void kinds_of_solvers(void)
{
    hp_options options = with(HP_SOLVER_EXPLICIT);
    hp_solver *heat = made(&options), *exact;
    options.estimator = HP_EIKONAL;
    exact = made(&options);
    EXPECT(HP_INVALID_ARGUMENT, "but the solver was made for heat",
           hp_solver_distances(heat, sources, SOURCES, &options, &first, 0));
    EXPECT(HP_OK, "", hp_solver_distances(exact, sources, SOURCES, &options, &first, 0));
    memcpy(expected, maps, sizeof maps);
    memset(maps, 0, sizeof maps);
    EXPECT(HP_OK, "", hp_solver_distances(exact, sources, SOURCES, NULL, &first, 0));
    CHECK(memcmp(maps, expected, sizeof maps) == 0);
    hp_solver_free(heat);
    hp_solver_free(exact);
}

static void refuse(int line, const hp_options *options, hp_status status, const char *words)
{
    hp_solver *solver = (hp_solver *)image_data;
    expect(line, "create", hp_solver_create(&image, &mask, options, &solver), status, words);
    CHECK(solver == NULL);
}

#define REFUSE(field, value, status, words)                                                        \
    do {                                                                                           \
        hp_options options = with(HP_SOLVER_IMPLICIT);                                             \
        options.field = (value);                                                                   \
        refuse(__LINE__, &options, (status), (words));                                             \
    } while (0)

static void wrong_creation(void)
{
    hp_options options = with(HP_SOLVER_EXPLICIT);
    hp_solver *solver = NULL;
    hp_buffer bad = mask;
    bad.size[0]--;
    hp_solver_free(NULL);
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL", hp_solver_create(&image, NULL, &options, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "image is NULL", hp_solver_create(NULL, NULL, &options, &solver));
    EXPECT(HP_INVALID_BUFFER, "mask has", hp_solver_create(&image, &bad, &options, &solver));
    refuse(__LINE__, NULL, HP_INVALID_ARGUMENT, "reference is not set");
    options.step = 0.3;
    refuse(__LINE__, &options, HP_UNSTABLE_STEP, "largest stable step");
    REFUSE(reference, NAN, HP_INVALID_ARGUMENT, "reference is not set");
    REFUSE(reference, INFINITY, HP_INVALID_ARGUMENT, "reference is inf");
    REFUSE(solver, 2, HP_INVALID_ARGUMENT, "solver is 2");
    REFUSE(reserved, 1, HP_INVALID_ARGUMENT, "reserved is 1");
    REFUSE(step, 0.1, HP_INVALID_ARGUMENT, "step is 0.1");
    REFUSE(step, 0, HP_INVALID_ARGUMENT, "step is 0");
    REFUSE(time, -1, HP_INVALID_ARGUMENT, "time is -1");
    REFUSE(time, 1e30, HP_INVALID_ARGUMENT, "too long");
    REFUSE(iterations, 1001, HP_INVALID_ARGUMENT, "steps is 1001");
    REFUSE(iterations, UINT64_MAX, HP_INVALID_ARGUMENT, "it must be from 1 to 1000");
    REFUSE(memory, 1, HP_OUT_OF_MEMORY, "of memory");
    REFUSE(memory, 100000, HP_OUT_OF_MEMORY, "explicit heat");
}

static void wrong_use(void)
{
    const double bad[4] = {3, 4, 99, 4}, in_wall[2] = {10, 2};
    hp_options options = with(HP_SOLVER_IMPLICIT);
    hp_solver *solver = made(&options);
    hp_buffer target = first, small = first, whole = first;
    memset(maps, 0x55, sizeof maps);
    memcpy(expected, maps, sizeof maps);
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL",
           hp_solver_distances(NULL, sources, SOURCES, NULL, &first, 0));
    EXPECT(HP_INVALID_ARGUMENT, "multiple",
           hp_solver_distances((hp_solver *)(void *)((char *)solver + 1), sources, 1, NULL, &first, 0));
    EXPECT(HP_INVALID_ARGUMENT, "distances is NULL",
           hp_solver_distances(solver, sources, SOURCES, NULL, NULL, 0));
    EXPECT(HP_INVALID_ARGUMENT, "sources is NULL",
           hp_solver_distances(solver, NULL, 1, NULL, &first, 0));
    EXPECT(HP_INVALID_POINT, "no source", hp_solver_distances(solver, sources, 0, NULL, &first, 0));
    EXPECT(HP_INVALID_POINT, "source 1", hp_solver_distances(solver, bad, 2, NULL, &first, 0));
    EXPECT(HP_INVALID_POINT, "wall", hp_solver_distances(solver, in_wall, 1, NULL, &first, 0));
    EXPECT(HP_INVALID_ARGUMENT, "points",
           hp_solver_distances(solver, sources, UINT64_MAX, NULL, &first, 0));
    small.size[1]--;
    EXPECT(HP_INVALID_BUFFER, "[24, 17]",
           hp_solver_distances(solver, sources, SOURCES, NULL, &small, 0));
    whole.type = HP_U16;
    EXPECT(HP_INVALID_BUFFER, "HP_F32", hp_solver_distances(solver, sources, 1, NULL, &whole, 0));
    target.data = NULL;
    EXPECT(HP_INVALID_BUFFER, "data is NULL",
           hp_solver_distances(solver, sources, 1, NULL, &target, 0));
    EXPECT(HP_INVALID_BUFFER, "the stride of maps is 8",
           hp_solver_distances(solver, sources, SOURCES, NULL, &first, 8));
    EXPECT(HP_INVALID_BUFFER, "outside of all memory",
           hp_solver_distances(solver, sources, SOURCES, NULL, &first, INT64_MAX));
    EXPECT(HP_INVALID_BUFFER, "outside of all memory",
           hp_solver_distances(solver, sources, SOURCES, NULL, &first, INT64_MIN));
    options.estimator = 7;
    EXPECT(HP_INVALID_ARGUMENT, "estimator is 7",
           hp_solver_distances(solver, sources, SOURCES, &options, &first, 0));
    CHECK(memcmp(maps, expected, sizeof maps) == 0);
    hp_solver_free(solver);
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

/* How often a call asks whether to go on. */
static int calls(const hp_solver *solver, hp_options options, int stop_at, hp_status wanted)
{
    struct watcher watcher = {0, 0, 0};
    hp_solver *other = NULL;
    watcher.stop_at = stop_at;
    options.progress = watch;
    options.user = &watcher;
    if (solver)
        EXPECT(wanted, "progress callback",
               hp_solver_distances(solver, sources, SOURCES, &options, &first, 0));
    else
        EXPECT(wanted, "progress callback", hp_solver_create(&image, &mask, &options, &other));
    CHECK(wanted != HP_OK || watcher.last == 1);
    CHECK(solver || (other == NULL) == (wanted != HP_OK));
    hp_solver_free(other);
    return watcher.calls;
}

static void cancelling(uint32_t kind, uint32_t estimator)
{
    hp_options options = with(kind);
    const hp_solver *of[2] = {NULL, NULL};
    hp_solver *solver;
    int i, stop_at;
    options.estimator = estimator;
    of[1] = solver = made(&options);
    for (i = 0; i < 2; i++) {
        const int all = calls(of[i], options, 0, HP_OK);
        CHECK(all >= 1);
        for (stop_at = 1; stop_at <= all; stop_at++)
            CHECK(calls(of[i], options, stop_at, HP_CANCELLED) == stop_at);
    }
    hp_solver_free(solver);
}

int main(void)
{
    int i;
    for (i = 0; i < PIXELS * DEPTH; i++) {
        image_data[i] = grey(i % WIDTH, i / WIDTH % HEIGHT);
        mask_data[i] = i % WIDTH != 10 || i / WIDTH % HEIGHT > 12;
    }
    image = buffer_of(image_data, HP_F64);
    mask = buffer_of(mask_data, HP_F64);
    first = buffer_of(maps, HP_F64);
    maps_of(HP_SOLVER_EXPLICIT, HP_NORMALIZED);
    maps_of(HP_SOLVER_EXPLICIT, HP_VARADHAN);
    maps_of(HP_SOLVER_IMPLICIT, HP_NORMALIZED);
    maps_of(HP_SOLVER_IMPLICIT, HP_VARADHAN);
    maps_of(HP_SOLVER_EXPLICIT, HP_EIKONAL);
    kinds_of_solvers();
    maps_with_gaps();
    volumes();
    paths_of_implicit_heat();
    wrong_creation();
    wrong_use();
    cancelling(HP_SOLVER_EXPLICIT, HP_NORMALIZED);
    cancelling(HP_SOLVER_IMPLICIT, HP_NORMALIZED);
    cancelling(HP_SOLVER_EXPLICIT, HP_EIKONAL);
    return failures != 0;
}
