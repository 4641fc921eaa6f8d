/* Curves without ends given: votes, key points, skeletons, and how well they agree with a truth. */
#include "check.h"

#include <stdlib.h>

enum { SIDE = 96, MIDDLE = 48 };

static uint8_t cross[SIDE * SIDE];

/* A dark cross, 5 pixels wide, on a bright ground; its arms end 8 pixels before the border. */
static void draw_cross(void)
{
    int x, y;
    for (y = 0; y < SIDE; y++)
        for (x = 0; x < SIDE; x++) {
            int across = abs(x - MIDDLE) < abs(y - MIDDLE) ? abs(x - MIDDLE) : abs(y - MIDDLE);
            int along = abs(x - MIDDLE) < abs(y - MIDDLE) ? abs(y - MIDDLE) : abs(x - MIDDLE);
            cross[y * SIDE + x] = across <= 2 && along <= 40 ? 40 : 200 + (7 * x + 3 * y) % 5;
        }
}

static hp_buffer describe(void *data, uint32_t type)
{
    hp_buffer buffer = buffer_of(data, type);
    buffer.size[0] = buffer.size[1] = SIDE;
    return buffer;
}

static hp_options dark_tubes(void)
{
    hp_options options = defaults();
    options.medium = HP_MEDIUM_VESSELNESS;
    options.polarity = HP_POLARITY_DARK;
    return options;
}

static hp_graph_info info_of(const hp_graph *graph)
{
    hp_graph_info info;
    info.struct_size = sizeof info;
    EXPECT(HP_OK, "", hp_graph_describe(graph, &info));
    return info;
}

/* All branches as curves to compare. */
static hp_score score_of(const hp_graph *graph, const hp_curves *truth, double tolerance)
{
    hp_graph_info info = info_of(graph);
    uint64_t *starts = calloc(info.branch_count + 1, sizeof *starts);
    double *points = NULL;
    hp_array points_array, starts_array;
    hp_curves curves;
    hp_score score;
    uint64_t i;
    for (i = 0; i < info.branch_count; i++) {
        hp_graph_branch branch;
        branch.struct_size = sizeof branch;
        EXPECT(HP_OK, "", hp_graph_branch_at(graph, i, &branch));
        starts[i + 1] = starts[i] + branch.point_count;
        points = realloc(points, 2 * starts[i + 1] * sizeof *points);
        EXPECT(HP_OK, "", hp_graph_branch_points(graph, i, points + 2 * starts[i], NULL,
                                                 branch.point_count));
    }
    EXPECT(HP_OK, "", hp_array_init(&points_array, sizeof points_array));
    starts_array = points_array;
    points_array.type = HP_F64, points_array.data = points;
    points_array.count = starts[info.branch_count];
    starts_array.type = HP_U64, starts_array.data = starts;
    starts_array.count = info.branch_count + 1;
    EXPECT(HP_OK, "", hp_curves_init(&curves, sizeof curves));
    curves.points = &points_array, curves.starts = &starts_array;
    score.struct_size = sizeof score;
    EXPECT(HP_OK, "", hp_evaluate(&curves, truth, NULL, tolerance, &score));
    free(starts);
    free(points);
    return score;
}

/* The centrelines of the cross. */
static float truth_points[] = {MIDDLE - 40, MIDDLE, MIDDLE + 40, MIDDLE,
                               MIDDLE, MIDDLE - 40, MIDDLE, MIDDLE + 40};
static uint8_t truth_starts[] = {0, 2, 4};
static hp_array truth_arrays[2];

static hp_curves truth_curves(void)
{
    hp_curves truth;
    EXPECT(HP_OK, "", hp_array_init(&truth_arrays[0], sizeof(hp_array)));
    truth_arrays[1] = truth_arrays[0];
    truth_arrays[0].type = HP_F32, truth_arrays[0].data = truth_points, truth_arrays[0].count = 4;
    truth_arrays[1].type = HP_U8, truth_arrays[1].data = truth_starts, truth_arrays[1].count = 3;
    EXPECT(HP_OK, "", hp_curves_init(&truth, sizeof truth));
    truth.points = &truth_arrays[0], truth.starts = &truth_arrays[1];
    return truth;
}

static void votes_find_the_cross(void)
{
    static double density[SIDE * SIDE];
    static uint8_t kept[SIDE * SIDE];
    hp_buffer image = describe(cross, HP_U8);
    hp_buffer density_buffer = describe(density, HP_F64), kept_buffer = describe(kept, HP_U8);
    hp_options options = dark_tubes();
    hp_curves truth = truth_curves();
    hp_graph *graph;
    hp_graph_info info;
    hp_score score;
    int i, crossed = 0;
    EXPECT(HP_OK, "", hp_votes_create(&image, NULL, NULL, 0, &options, NULL, &density_buffer,
                                      &kept_buffer, &graph));
    info = info_of(graph);
    CHECK(info.dimension == 2 && info.source_count == 1 && info.branch_count >= 4);
    CHECK(info.rounds >= 1 && info.stop == HP_STOP_SETTLED);
    score = score_of(graph, &truth, 2);
    CHECK(score.recall > 0.9 && score.precision > 0.95);
    CHECK(fabs(score.truth_length - 160) < 3); /* the crossing counts once */
    CHECK(fabs(score.extracted_length - info.physical_length) < 5);
    for (i = 0; i < SIDE * SIDE; i++) {
        CHECK(kept[i] == 0 || kept[i] == 255);
        crossed += density[i] > 0;
    }
    CHECK(crossed > 100);
    {
        double source[2];
        hp_graph_node node;
        node.struct_size = sizeof node;
        EXPECT(HP_OK, "", hp_graph_sources(graph, source, 1));
        CHECK(cross[(int)source[1] * SIDE + (int)source[0]] == 40);
        EXPECT(HP_OK, "", hp_graph_node_at(graph, 0, &node));
        CHECK(node.degree >= 1 && node.radius > 1 && node.radius < 4 && node.parent == -1);
        EXPECT(HP_INVALID_ARGUMENT, "capacity is 0", hp_graph_sources(graph, source, 0));
        EXPECT(HP_INVALID_ARGUMENT, "node 999 does not exist", hp_graph_node_at(graph, 999, &node));
    }
    hp_graph_free(graph);
    hp_graph_free(NULL);
}

static void key_points_find_the_cross(uint32_t method, uint64_t least_nodes, double least_recall)
{
    hp_buffer image = describe(cross, HP_U8);
    hp_options options = dark_tubes();
    hp_key_point_options how;
    hp_curves truth = truth_curves();
    hp_graph *graph;
    hp_graph_info info;
    hp_score score;
    const double source[2] = {MIDDLE - 30, MIDDLE};
    uint64_t i;
    EXPECT(HP_OK, "", hp_key_point_options_init(&how, sizeof how));
    how.method = method;
    how.radius = 12;
    EXPECT(HP_OK, "", hp_key_points_create(&image, NULL, source, 1, &options, &how, &graph));
    info = info_of(graph);
    CHECK(info.source_count == 1 && info.node_count >= least_nodes);
    CHECK(info.branch_count >= info.node_count - 1);
    CHECK(info.stop == HP_STOP_COMPLETE && info.rounds == 0);
    for (i = 0; i < info.node_count; i++) {
        hp_graph_node node;
        node.struct_size = sizeof node;
        EXPECT(HP_OK, "", hp_graph_node_at(graph, i, &node));
        CHECK(i == 0 ? node.parent == -1 && node.point[0] == source[0]
                     : node.parent >= 0 && node.parent < (int64_t)i);
        CHECK(isnan(node.radius) && node.point[2] == 0);
    }
    score = score_of(graph, &truth, 2);
    CHECK(score.recall > least_recall && score.precision > 0.95);
    hp_graph_free(graph);
}

static void skeletons_have_radii(void)
{
    static uint8_t bar[SIDE * SIDE];
    double points[2 * SIDE], radii[SIDE];
    hp_buffer mask = describe(bar, HP_U8);
    hp_graph *graph;
    hp_graph_branch branch;
    int x, y;
    for (y = 40; y < 47; y++)
        for (x = 10; x < 80; x++)
            bar[y * SIDE + x] = 1;
    mask.spacing[0] = mask.spacing[1] = 0.5;
    EXPECT(HP_OK, "", hp_skeleton_create(&mask, 0, &graph));
    CHECK(info_of(graph).branch_count == 1 && info_of(graph).node_count == 2);
    branch.struct_size = sizeof branch;
    EXPECT(HP_OK, "", hp_graph_branch_at(graph, 0, &branch));
    EXPECT(HP_INVALID_ARGUMENT, "branch 1 does not exist", hp_graph_branch_at(graph, 1, &branch));
    CHECK(branch.point_count <= SIDE && fabs(branch.physical_length - branch.length / 2) < 1e-9);
    EXPECT(HP_OK, "", hp_graph_branch_points(graph, 0, points, radii, SIDE));
    CHECK(fabs(points[2 * (branch.point_count / 2) + 1] - 43) < 1e-9);
    CHECK(fabs(radii[branch.point_count / 2] - 1.75) < 1e-9);
    hp_graph_free(graph);
    EXPECT(HP_INVALID_ARGUMENT, "prune is -1", hp_skeleton_create(&mask, -1, &graph));
    CHECK(graph == NULL);
}

static void masks_are_curves_too(void)
{
    static uint8_t line[SIDE * SIDE];
    hp_buffer mask = describe(line, HP_U8), half;
    hp_curves extracted, truth = truth_curves();
    hp_score score;
    int i;
    for (i = MIDDLE - 40; i <= MIDDLE + 40; i++)
        line[MIDDLE * SIDE + i] = 1;
    EXPECT(HP_OK, "", hp_curves_init(&extracted, sizeof extracted));
    extracted.mask = &mask;
    score.struct_size = sizeof score;
    EXPECT(HP_OK, "", hp_evaluate(&extracted, &truth, NULL, 0.5, &score));
    CHECK(score.precision == 1 && fabs(score.recall - 0.5) < 0.02);
    CHECK(fabs(score.f1 - 2 * score.recall / (1 + score.recall)) < 1e-12);
    half = mask; /* only the rows that the line is in */
    EXPECT(HP_OK, "", hp_evaluate(&extracted, &truth, &half, 0.5, &score));
    CHECK(score.precision == 1 && score.recall == 1);
    EXPECT(HP_INVALID_ARGUMENT, "tolerance -1", hp_evaluate(&extracted, &truth, NULL, -1, &score));
    truth_starts[2] = 5;
    EXPECT(HP_INVALID_BUFFER, "number of points, 4",
           hp_evaluate(&extracted, &truth, NULL, 1, &score));
    truth_starts[2] = 4;
    truth.dimension = 4;
    EXPECT(HP_INVALID_ARGUMENT, "must be 2 or 3", hp_evaluate(&extracted, &truth, NULL, 1, &score));
    truth.dimension = 3;
    EXPECT(HP_INVALID_BUFFER, "dimension is 2", hp_evaluate(&extracted, &truth, NULL, 1, &score));
    EXPECT(HP_INVALID_ARGUMENT, "truth is NULL", hp_evaluate(&extracted, NULL, NULL, 1, &score));
}

static int stop_at_once(double finished, void *user)
{
    (void)user;
    return finished >= 0;
}

static void wrong_calls_fail_in_words(void)
{
    static double density[SIDE * SIDE];
    hp_buffer image = describe(cross, HP_U8), target = describe(density, HP_F64);
    hp_options options = dark_tubes();
    hp_vote_options how;
    hp_key_point_options points;
    hp_graph *graph = (hp_graph *)&image;
    const double outside[2] = {-7, 0};
    EXPECT(HP_OK, "", hp_vote_options_init(&how, sizeof how));
    EXPECT(HP_OK, "", hp_key_point_options_init(&points, sizeof points));
    EXPECT(HP_INVALID_POINT, "source 0 at [-7.0, 0.0]",
           hp_votes_create(&image, NULL, outside, 1, &options, NULL, NULL, NULL, &graph));
    CHECK(graph == NULL);
    EXPECT(HP_INVALID_ARGUMENT, "graph is NULL",
           hp_votes_create(&image, NULL, NULL, 0, &options, NULL, NULL, NULL, NULL));
    EXPECT(HP_INVALID_BUFFER, "kept: its type must be HP_U8",
           hp_votes_create(&image, NULL, NULL, 0, &options, NULL, NULL, &target, &graph));
    EXPECT(HP_INVALID_BUFFER, "density: its type must be",
           hp_votes_create(&image, NULL, NULL, 0, &options, NULL, &image, NULL, &graph));
    how.method = 7;
    EXPECT(HP_INVALID_ARGUMENT, "vote_options: method is 7",
           hp_votes_create(&image, NULL, NULL, 0, &options, &how, NULL, NULL, &graph));
    how.method = 0, how.gap = -1;
    EXPECT(HP_INVALID_ARGUMENT, "gap", hp_votes_create(&image, NULL, NULL, 0, &options, &how, NULL,
                                                       NULL, &graph));
    how.gap = 6, how.extent = 1e6;
    EXPECT(HP_NO_ANSWER, "no piece of the structure",
           hp_votes_create(&image, NULL, NULL, 0, &options, &how, NULL, NULL, &graph));
    points.method = 2;
    EXPECT(HP_INVALID_ARGUMENT, "key_point_options: method is 2",
           hp_key_points_create(&image, NULL, NULL, 0, &options, &points, &graph));
    points.method = 0, points.radius = 1;
    EXPECT(HP_INVALID_ARGUMENT, "radius",
           hp_key_points_create(&image, NULL, NULL, 0, &options, &points, &graph));
    options.medium = HP_MEDIUM_UNIFORM;
    EXPECT(HP_NO_ANSWER, "shows no structure",
           hp_key_points_create(&image, NULL, NULL, 0, &options, NULL, &graph));
    options = dark_tubes();
    options.progress = stop_at_once;
    EXPECT(HP_CANCELLED, "cancelled",
           hp_votes_create(&image, NULL, NULL, 0, &options, NULL, NULL, NULL, &graph));
    EXPECT(HP_CANCELLED, "cancelled",
           hp_key_points_create(&image, NULL, NULL, 0, &options, NULL, &graph));
    CHECK(graph == NULL);
}

int main(void)
{
    draw_cross();
    votes_find_the_cross();
    key_points_find_the_cross(HP_KEY_POINTS_HEAT, 10, 0.9);
    key_points_find_the_cross(HP_KEY_POINTS_LENGTH, 3, 0.1); /* its rules end it early */
    skeletons_have_radii();
    masks_are_curves_too();
    wrong_calls_fail_in_words();
    return failures != 0;
}
