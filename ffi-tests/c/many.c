/* Labels, matrices and bridges of many points: against closed forms, and misuse fails in words. */
#include "mesh_check.h"

enum { DEPTH = 5, SOURCES = 2, ENDS = 3 };

static double image_data[PIXELS * DEPTH], mask_data[PIXELS * DEPTH], distance_data[PIXELS * DEPTH];
static double share_data[SOURCES][PIXELS * DEPTH], rows[SOURCES][ENDS];
static int32_t label_data[PIXELS * DEPTH];
static hp_buffer image, mask, distance, labels, shares;
static hp_array row;
static const double sources[2 * SOURCES] = {4, 9, 19, 9}, ends[2 * ENDS] = {6, 3, 11.5, 12, 21, 9};

static hp_solver *made(uint32_t estimator, uint32_t kind, const hp_buffer *walls)
{
    hp_options options = defaults();
    hp_solver *solver = NULL;
    options.medium = HP_MEDIUM_UNIFORM;
    options.estimator = estimator;
    options.solver = kind;
    EXPECT(HP_OK, "", hp_solver_create(&image, walls, &options, &solver));
    CHECK(solver != NULL);
    return solver;
}

/* The sources are symmetric about x = 11.5, where the labels change. Borders reflect heat, so that far
 * distances are short in so small a picture. */
static void labelled(uint32_t estimator, uint32_t kind)
{
    const int is_heat = estimator != HP_EIKONAL;
    const int64_t stride = sizeof share_data[0];
    hp_solver *solver = made(estimator, kind, NULL);
    int i;
    memset(label_data, 0x55, sizeof label_data);
    EXPECT(HP_OK, "", hp_solver_nearest(solver, sources, SOURCES, NULL, &distance, &labels,
                                        is_heat ? &shares : NULL, stride));
    for (i = 0; i < PIXELS; i++) {
        const int side = i % WIDTH >= 12;
        const double from = hypot(i % WIDTH - sources[2 * side], i / WIDTH - 9);
        CHECK(label_data[i] == side);
        CHECK(fabs(distance_data[i] - from) < (is_heat ? 5 : 0.01));
        if (is_heat) {
            CHECK(fabs(share_data[0][i] + share_data[1][i] - 1) < 1e-12);
            CHECK(share_data[side][i] > 0.5);
        }
    }
    hp_solver_free(solver);
}

/* Nothing comes through the wall. */
static void labels_behind_walls(void)
{
    static uint32_t bits[PIXELS];
    const hp_buffer target = buffer_of(bits, HP_U32);
    hp_solver *solver = made(HP_EIKONAL, 0, &mask);
    int i;
    EXPECT(HP_OK, "", hp_solver_nearest(solver, sources, 1, NULL, NULL, &target, NULL, 0));
    for (i = 0; i < PIXELS; i++)
        CHECK(bits[i] == (i % WIDTH >= 10 ? UINT32_MAX : 0));
    hp_solver_free(solver);
}

/* The second map lies before the first. */
static void volumes(void)
{
    const double at[3 * SOURCES] = {4, 9, 2, 19, 9, 2};
    hp_buffer volume = image, numbers = labels, first = shares;
    hp_options options = defaults();
    hp_solver *solver = NULL;
    int i;
    options.medium = HP_MEDIUM_UNIFORM;
    volume.dimension = numbers.dimension = first.dimension = 3;
    volume.size[2] = numbers.size[2] = first.size[2] = DEPTH;
    first.data = share_data[1];
    EXPECT(HP_OK, "", hp_solver_create(&volume, NULL, &options, &solver));
    EXPECT(HP_OK, "", hp_solver_nearest(solver, at, SOURCES, NULL, NULL, &numbers, &first,
                                        -(int64_t)sizeof share_data[0]));
    for (i = 0; i < PIXELS * DEPTH; i++) {
        CHECK(label_data[i] == (i % WIDTH >= 12));
        CHECK((share_data[1][i] > share_data[0][i]) == (label_data[i] == 0));
    }
    hp_solver_free(solver);
}

/* Rows are right to an error, and so are they the other way round. */
static void matrices(uint32_t estimator, uint32_t kind, double error)
{
    static double back[ENDS][SOURCES];
    const hp_array turned = array_of(back, HP_F64, SOURCES);
    hp_solver *solver = made(estimator, kind, NULL);
    int i, j;
    EXPECT(HP_OK, "", hp_solver_matrix(solver, sources, SOURCES, ends, ENDS, NULL, &row, 0));
    EXPECT(HP_OK, "", hp_solver_matrix(solver, ends, ENDS, sources, SOURCES, NULL, &turned, 0));
    for (i = 0; i < SOURCES; i++)
        for (j = 0; j < ENDS; j++) {
            const double dx = sources[2 * i] - ends[2 * j], dy = sources[2 * i + 1] - ends[2 * j + 1];
            CHECK(fabs(rows[i][j] - hypot(dx, dy)) < error);
            CHECK(fabs(back[j][i] - hypot(dx, dy)) < error);
        }
    hp_solver_free(solver);
}

static void bridges(void)
{
    hp_solver *solver = made(HP_NORMALIZED, HP_SOLVER_IMPLICIT, NULL);
    int x, y;
    EXPECT(HP_OK, "", hp_solver_bridge(solver, sources, 1, sources + 2, 1, NULL, &distance));
    for (x = 6; x < 18; x++)
        for (y = 0; y < HEIGHT; y++)
            CHECK(y == 9 || distance_data[9 * WIDTH + x] > distance_data[y * WIDTH + x]);
    hp_solver_free(solver);
}

static void wrong_bridges(void)
{
    hp_solver *parted = made(HP_NORMALIZED, HP_SOLVER_IMPLICIT, &mask);
    hp_solver *exact = made(HP_EIKONAL, 0, NULL);
    memset(distance_data, 0x55, sizeof distance_data);
    memcpy(share_data, distance_data, sizeof distance_data);
#define BRIDGE(solver, from, from_count, to_count, target)                                         \
    hp_solver_bridge((solver), (from), (from_count), sources + 2, (to_count), NULL, (target))
    EXPECT(HP_NO_ANSWER, "no heat from one end", BRIDGE(parted, sources, 1, 1, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "a bridge is of heat", BRIDGE(exact, sources, 1, 1, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL", BRIDGE(NULL, sources, 1, 1, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "ln_density is NULL", BRIDGE(parted, sources, 1, 1, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "from is NULL", BRIDGE(parted, NULL, 1, 1, &distance));
    EXPECT(HP_INVALID_POINT, "no from point", BRIDGE(parted, sources, 0, 1, &distance));
    EXPECT(HP_INVALID_POINT, "no to point", BRIDGE(parted, sources, 1, 0, &distance));
    EXPECT(HP_INVALID_BUFFER, "its type must be HP_F32", BRIDGE(parted, sources, 1, 1, &labels));
#undef BRIDGE
    CHECK(memcmp(share_data, distance_data, sizeof distance_data) == 0);
    hp_solver_free(parted);
    hp_solver_free(exact);
}

static void wrong_labels(void)
{
    hp_solver *heat = made(HP_NORMALIZED, HP_SOLVER_EXPLICIT, NULL);
    hp_solver *exact = made(HP_EIKONAL, 0, NULL), *method = made(HP_HEAT_METHOD, 0, NULL);
    hp_options options = defaults();
    hp_buffer bytes = labels, small = labels;
    bytes.type = HP_U8;
    small.size[0]--;
    options.estimator = HP_HEAT_METHOD;
#define NEAREST(solver, options, to, numbers, first)                                               \
    hp_solver_nearest((solver), sources, SOURCES, (options), (to), (numbers), (first), 0)
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL", NEAREST(NULL, NULL, NULL, &labels, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "nothing is wanted", NEAREST(heat, NULL, NULL, NULL, NULL));
    EXPECT(HP_INVALID_BUFFER, "labels: its type must be HP_I32", NEAREST(heat, NULL, NULL, &bytes, NULL));
    EXPECT(HP_INVALID_BUFFER, "labels: it has [23, 18]", NEAREST(heat, NULL, NULL, &small, NULL));
    EXPECT(HP_INVALID_BUFFER, "shares: its type must be", NEAREST(heat, NULL, NULL, NULL, &labels));
    EXPECT(HP_INVALID_BUFFER, "distance: its type must be", NEAREST(heat, NULL, &labels, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "shares are of heat", NEAREST(exact, NULL, NULL, NULL, &shares));
    EXPECT(HP_INVALID_ARGUMENT, "HP_HEAT_METHOD", NEAREST(method, NULL, NULL, &labels, NULL));
    EXPECT(HP_OK, "", NEAREST(method, NULL, &distance, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "made for heat", NEAREST(heat, &options, &distance, NULL, NULL));
#undef NEAREST
    EXPECT(HP_INVALID_BUFFER, "shares: the stride of maps is 8",
           hp_solver_nearest(heat, sources, SOURCES, NULL, NULL, NULL, &shares, 8));
    EXPECT(HP_INVALID_POINT, "no source", hp_solver_nearest(heat, NULL, 0, NULL, NULL, &labels, NULL, 0));
    hp_solver_free(heat);
    hp_solver_free(exact);
    hp_solver_free(method);
}

static void wrong_matrices(void)
{
    const double outside[4] = {1, 1, 99, 0};
    hp_solver *solver = made(HP_NORMALIZED, HP_SOLVER_EXPLICIT, NULL);
    hp_array list = row;
    list.type = HP_I32;
#define MATRIX(solver, to, count, list)                                                            \
    hp_solver_matrix((solver), sources, SOURCES, (to), (count), NULL, (list), 0)
    EXPECT(HP_INVALID_POINT, "to 1 at [99.0, 0.0] lies outside", MATRIX(solver, outside, 2, &row));
    EXPECT(HP_INVALID_BUFFER, "distances: count is 3; it must be 2", MATRIX(solver, ends, 2, &row));
    EXPECT(HP_INVALID_ARGUMENT, "to is NULL", MATRIX(solver, NULL, 2, &row));
    EXPECT(HP_INVALID_POINT, "no to point", MATRIX(solver, NULL, 0, &row));
    EXPECT(HP_INVALID_ARGUMENT, "distances is NULL", MATRIX(solver, ends, ENDS, NULL));
    EXPECT(HP_INVALID_BUFFER, "distances: its type", MATRIX(solver, ends, ENDS, &list));
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL", MATRIX(NULL, ends, ENDS, &row));
#undef MATRIX
    hp_solver_free(solver);
}

int main(void)
{
    int i;
    for (i = 0; i < PIXELS * DEPTH; i++)
        mask_data[i] = i % WIDTH != 10;
    image = buffer_of(image_data, HP_F64);
    mask = buffer_of(mask_data, HP_F64);
    distance = buffer_of(distance_data, HP_F64);
    labels = buffer_of(label_data, HP_I32);
    shares = buffer_of(share_data[0], HP_F64);
    row = array_of(rows, HP_F64, ENDS);
    labelled(HP_NORMALIZED, HP_SOLVER_EXPLICIT);
    labelled(HP_NORMALIZED, HP_SOLVER_IMPLICIT);
    labelled(HP_EIKONAL, 0);
    labels_behind_walls();
    volumes();
    matrices(HP_NORMALIZED, HP_SOLVER_EXPLICIT, 2.5);
    matrices(HP_NORMALIZED, HP_SOLVER_IMPLICIT, 2.5);
    matrices(HP_EIKONAL, 0, 0.01);
    matrices(HP_HEAT_METHOD, 0, 0.1);
    bridges();
    wrong_bridges();
    wrong_labels();
    wrong_matrices();
    return failures != 0;
}
