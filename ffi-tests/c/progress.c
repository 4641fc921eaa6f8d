/* The progress of every call that reports it is one run from 0 to 1, which never goes back. */
#include "mesh_check.h"

static double image_data[PIXELS], result_data[4 * PIXELS];
static hp_buffer image, result;
static const double sources[6] = {3, 4, 20, 15, 7.25, 9.5}, ends[4] = {18, 3, 2, 15};
static double curvatures[VERTICES], rows[VERTICES][VERTICES];
static const uint32_t numbers[3] = {0, 17, 200};

struct run {
    const char *call;
    int reports, complete;
    double furthest;
};

static int watch(double finished, void *user)
{
    struct run *run = user;
    if (!(finished >= run->furthest && finished <= 1)) {
        printf("%s: from %g to %g\n", run->call, run->furthest, finished);
        failures++;
    }
    run->furthest = finished;
    run->reports++;
    run->complete += finished == 1;
    return 0;
}

/* A run that began anew would be complete more often than at the end of the work and of the call. */
static void check_run(const struct run *run)
{
    if (run->reports >= 1 && run->furthest == 1 && run->complete <= 2)
        return;
    printf("%s: %d reports up to %g, %d times all\n", run->call, run->reports, run->furthest,
           run->complete);
    failures++;
}

/* Makes a call with options that watch. */
#define RUN(call_, options)                                                                        \
    do {                                                                                           \
        struct run run = {#call_, 0, 0, 0};                                                        \
        (options).progress = watch;                                                                \
        (options).user = &run;                                                                     \
        EXPECT(HP_OK, "", call_);                                                                  \
        check_run(&run);                                                                           \
    } while (0)

static void solvers(hp_options options)
{
    const hp_array row = array_of(result_data, HP_F64, 2);
    const hp_buffer labels = buffer_of(rows, HP_I32), shares = buffer_of(rows[VERTICES / 2], HP_F64);
    hp_solver *solver = NULL;
    hp_paths *paths = NULL;
    RUN(hp_solver_create(&image, NULL, &options, &solver), options);
    RUN(hp_solver_distances(solver, sources, 3, &options, &result, 0), options);
    RUN(hp_solver_paths_create(solver, sources, 3, ends, 2, &options, &paths), options);
    hp_paths_free(paths);
    RUN(hp_solver_matrix(solver, sources, 3, ends, 2, &options, &row, 0), options);
    RUN(hp_solver_nearest(solver, sources, 3, &options, &result, NULL, NULL, 0), options);
    if (options.estimator != HP_HEAT_METHOD) {
        RUN(hp_solver_nearest(solver, sources, 3, &options, &result, &labels, NULL, 0), options);
        RUN(hp_solver_nearest(solver, sources, 3, &options, NULL, &labels, NULL, 0), options);
    }
    if (options.estimator <= HP_VARADHAN) {
        RUN(hp_solver_nearest(solver, sources, 3, &options, NULL, NULL, &shares, 0), options);
        RUN(hp_solver_bridge(solver, sources, 1, ends, 1, &options, &result), options);
    }
    hp_solver_free(solver);
}

static void images(hp_options options)
{
    hp_paths *paths = NULL;
    double scales[HP_MOST_TUBE_SCALES];
    uint64_t count;
    options.reference = 0.75;
    RUN(hp_medium(&image, NULL, NULL, 0, &options, &result), options);
    if (options.medium == HP_MEDIUM_VESSELNESS)
        RUN(hp_tube_scales(&image, NULL, &options, scales, &count), options);
    RUN(hp_distance(&image, NULL, sources, 3, &options, &result), options);
    RUN(hp_paths_create(&image, NULL, sources, 3, ends, 2, &options, &paths), options);
    hp_paths_free(paths);
    solvers(options);
}

static void extraction(hp_options options)
{
    hp_graph *graph = NULL;
    hp_vote_options votes;
    hp_key_point_options points_options;
    uint32_t method;
    EXPECT(HP_OK, "", hp_vote_options_init(&votes, sizeof votes));
    EXPECT(HP_OK, "", hp_key_point_options_init(&points_options, sizeof points_options));
    for (method = HP_VOTES_ACCUMULATED; method <= HP_VOTES_BORDER; method++) {
        votes.method = method;
        RUN(hp_votes_create(&image, NULL, sources, 1, &options, &votes, NULL, NULL, &graph), options);
        hp_graph_free(graph);
    }
    RUN(hp_votes_create(&image, NULL, NULL, 0, &options, NULL, NULL, NULL, &graph), options);
    hp_graph_free(graph);
    points_options.radius = 6;
    for (method = HP_KEY_POINTS_HEAT; method <= HP_KEY_POINTS_LENGTH; method++) {
        points_options.method = method;
        RUN(hp_key_points_create(&image, NULL, sources, 1, &options, &points_options, &graph), options);
        hp_graph_free(graph);
    }
}

static void meshes(hp_mesh_options options)
{
    static const uint64_t starts[4] = {0, 1, 2, 3};
    const hp_array xyz = array_of(points, HP_F64, VERTICES), corners = array_of(faces, HP_U32, FACES);
    const hp_array three = array_of(numbers, HP_U32, 3), sets = array_of(starts, HP_U64, 4);
    const hp_array bends = array_of(curvatures, HP_F64, VERTICES), row = array_of(rows, HP_F64, VERTICES);
    hp_surface_points places = at_vertices(&three), each = places;
    hp_mesh *mesh = NULL;
    hp_mesh_solver *solver = NULL;
    hp_paths *paths = NULL;
    each.sets = &sets;
    RUN(hp_mesh_create(&xyz, &corners, NULL, &options, &mesh), options);
    RUN(hp_mesh_curvature(mesh, &options, &bends, NULL, NULL, NULL), options);
    RUN(hp_mesh_solver_create(mesh, &options, &solver), options);
    RUN(hp_mesh_solver_distances(solver, &each, &options, &row, 0, NULL, 0), options);
    RUN(hp_mesh_solver_distances(solver, &places, &options, &row, 0, NULL, 0), options);
    RUN(hp_mesh_paths_create(solver, &places, &places, &options, &paths), options);
    hp_paths_free(paths);
    RUN(hp_mesh_paths_through(solver, &places, &options, &paths), options);
    hp_paths_free(paths);
    if (options.method == HP_MESH_HEAT)
        RUN(hp_mesh_solver_matrix(solver, &options, &row, 0), options);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

static void with_threads(uint32_t threads)
{
    hp_options options = defaults();
    hp_mesh_options mesh_options = mesh_defaults();
    uint32_t number;
    options.threads = mesh_options.threads = threads;
    for (number = HP_NORMALIZED; number <= HP_HEAT_METHOD; number++) {
        options.estimator = number;
        images(options);
    }
    options.estimator = HP_NORMALIZED;
    options.solver = HP_SOLVER_IMPLICIT;
    images(options);
    options.solver = HP_SOLVER_EXPLICIT;
    options.medium = HP_MEDIUM_VESSELNESS;
    extraction(options);
    options.normalize = 5;
    images(options);
    for (number = HP_MESH_AUTO; number <= HP_MESH_EXPLICIT; number++) {
        mesh_options.method = number;
        meshes(mesh_options);
    }
    mesh_options.medium = HP_MESH_CURVATURE;
    mesh_options.method = HP_MESH_HEAT;
    meshes(mesh_options);
}

int main(void)
{
    int i;
    for (i = 0; i < PIXELS; i++)
        image_data[i] = grey(i % WIDTH, i / WIDTH);
    image = buffer_of(image_data, HP_F64);
    result = buffer_of(result_data, HP_F64);
    make_sphere();
    with_threads(1);
    with_threads(3);
    return failures != 0;
}
