/* Media that an image makes, by themselves and prepared; and the heat method. */
#include "check.h"

static uint8_t band[PIXELS];
static hp_buffer image;
static const double source[2] = {4, 5}, end[2] = {20, 15}, outside[2] = {-1, 0};

static void medium_of(const hp_options *options, double *speed)
{
    hp_buffer target = buffer_of(speed, HP_F64);
    EXPECT(HP_OK, "", hp_medium(&image, NULL, source, 1, options, &target));
}

/* Eq. (6), the simplest to work out. */
static void conductivity_is_as_the_header_says(void)
{
    static double speed[PIXELS];
    hp_options options = defaults();
    double f0 = band[5 * WIDTH + 4] / 255.0;
    int i;
    medium_of(&options, speed);
    for (i = 0; i < PIXELS; i++) {
        double k = pow(fabs(1 - fabs(f0 - band[i] / 255.0)), 3) + 1e-3;
        CHECK(fabs(speed[i] - k) < 1e-12);
    }
}

static void tubes_are_fast(void)
{
    static double speed[PIXELS];
    hp_options options = defaults();
    const double scales[2] = {2, 3};
    options.medium = HP_MEDIUM_VESSELNESS;
    options.scales = scales, options.scale_count = 2;
    medium_of(&options, speed);
    CHECK(speed[10 * WIDTH + 10] > 0.1);
    CHECK(speed[2 * WIDTH + 20] < 0.01);
    options.polarity = HP_POLARITY_DARK;
    medium_of(&options, speed);
    CHECK(speed[10 * WIDTH + 10] < 0.01);
    options.polarity = HP_POLARITY_BOTH, options.anisotropy = 0.5, options.normalize = 5;
    options.elongation = 2;
    medium_of(&options, speed);
    CHECK(speed[10 * WIDTH + 10] > 1e-4);
}

/* The middle of the bands that are seen best is 4 and 8 pixels wide. */
static void scales_are_found(void)
{
    enum { SIDE = 128 };
    static uint8_t bands[SIDE * SIDE];
    hp_buffer wide = buffer_of(bands, HP_U8);
    hp_options options = defaults();
    double scales[HP_MOST_TUBE_SCALES] = {-1, -1, -1};
    uint64_t count = 77;
    int i;
    wide.size[0] = wide.size[1] = SIDE;
    options.medium = HP_MEDIUM_VESSELNESS;
    EXPECT(HP_NO_ANSWER, "no tube that is", hp_tube_scales(&wide, NULL, &options, scales, &count));
    CHECK(count == 77 && scales[0] == -1);
    for (i = 0; i < SIDE * SIDE; i++) {
        int y = i / SIDE;
        bands[i] = (uint8_t)((y >= 30 && y < 34) || (y >= 80 && y < 88) ? 200 : 40);
    }
    EXPECT(HP_OK, "", hp_tube_scales(&wide, NULL, &options, scales, &count));
    CHECK(count >= 2 && scales[0] > 1 && scales[0] < 2.5);
    CHECK(scales[count - 1] > 2.5 && scales[count - 1] < 5);
    options.polarity = HP_POLARITY_DARK;
    EXPECT(HP_OK, "", hp_tube_scales(&wide, NULL, &options, scales, &count));
    CHECK(count >= 1 && scales[count - 1] > 5);
    EXPECT(HP_INVALID_ARGUMENT, "NULL", hp_tube_scales(&wide, NULL, &options, scales, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "NULL", hp_tube_scales(&wide, NULL, &options, NULL, &count));
    options.medium = HP_MEDIUM_UNIFORM;
    EXPECT(HP_INVALID_ARGUMENT, "HP_MEDIUM_VESSELNESS",
           hp_tube_scales(&wide, NULL, &options, scales, &count));
}

/* With D = 1 along and (1 - A) / (1 + A) across, det(D)^(1/2) is the same everywhere. */
static void directions_are_as_the_header_says(void)
{
    static double speed[PIXELS];
    hp_options options = defaults();
    uint32_t directions;
    int i;
    options.medium = HP_MEDIUM_TENSOR;
    for (directions = HP_DIRECTIONS_HESSIAN; directions <= HP_DIRECTIONS_GRADIENT; directions++) {
        options.directions = directions;
        options.anisotropy = 0.6;
        medium_of(&options, speed);
        for (i = 0; i < PIXELS; i++)
            CHECK(fabs(speed[i] - 0.5) < 1e-12);
        options.anisotropy = 0;
        medium_of(&options, speed);
        for (i = 0; i < PIXELS; i++)
            CHECK(fabs(speed[i] - sqrt(0.1 / 1.9)) < 1e-12);
    }
}

static void walls_can_be_thicker(void)
{
    static double speed[PIXELS];
    static uint8_t open[PIXELS];
    hp_buffer mask = buffer_of(open, HP_U8), target = buffer_of(speed, HP_F64);
    hp_options options = defaults();
    int i, closed[2] = {0, 0};
    memset(open, 1, sizeof open);
    open[9 * WIDTH + 18] = 0;
    options.medium = HP_MEDIUM_UNIFORM;
    EXPECT(HP_OK, "", hp_medium(&image, &mask, NULL, 0, &options, &target));
    for (i = 0; i < PIXELS; i++)
        closed[0] += speed[i] == 0;
    options.margin = 2;
    EXPECT(HP_OK, "", hp_medium(&image, &mask, NULL, 0, &options, &target));
    for (i = 0; i < PIXELS; i++)
        closed[1] += speed[i] == 0;
    CHECK(closed[0] == 1 && closed[1] > 5 && closed[1] < 30);
    options.margin = 100;
    EXPECT(HP_INVALID_ARGUMENT, "margin is 100",
           hp_medium(&image, &mask, NULL, 0, &options, &target));
}

/* On a medium that is the same everywhere the heat method gives Euclidean distances. */
static void the_heat_method_gives_lengths(void)
{
    static double distances[2][PIXELS];
    hp_buffer target = buffer_of(distances[0], HP_F64);
    hp_options options = defaults();
    hp_solver *solver;
    hp_paths *paths;
    hp_path_info info;
    double worst = 0;
    int i;
    options.medium = HP_MEDIUM_UNIFORM;
    options.estimator = HP_HEAT_METHOD;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &target));
    for (i = 0; i < PIXELS; i++) {
        double exact = hypot(i % WIDTH - source[0], i / WIDTH - source[1]);
        worst = fmax(worst, fabs(distances[0][i] - exact));
    }
    CHECK(worst < 0.3);
    EXPECT(HP_OK, "", hp_solver_create(&image, NULL, &options, &solver));
    target.data = distances[1];
    EXPECT(HP_OK, "", hp_solver_distances(solver, source, 1, &options, &target, 0));
    CHECK(memcmp(distances[0], distances[1], sizeof distances[0]) == 0);
    EXPECT(HP_OK, "", hp_solver_paths_create(solver, source, 1, end, 1, &options, &paths));
    info.struct_size = sizeof info;
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    CHECK(info.ending == HP_ENDED_SOURCE);
    CHECK(fabs(info.length - hypot(end[0] - source[0], end[1] - source[1])) < 0.2);
    CHECK(fabs(info.cost - info.length) < 1e-9);
    hp_paths_free(paths);
    hp_solver_free(solver);
    options.medium = HP_MEDIUM_TENSOR;
    EXPECT(HP_INVALID_ARGUMENT, "tensor", hp_distance(&image, NULL, source, 1, &options, &target));
}

/* The same paths at once and from what was prepared, bit for bit, by all methods. */
static void prepared_paths_are_the_same(uint32_t estimator, uint32_t solver_kind)
{
    hp_options options = defaults();
    hp_solver *solver;
    hp_paths *once, *prepared;
    hp_path_info infos[2];
    static double points[2][2 * PIXELS];
    options.reference = 0.8;
    options.estimator = estimator;
    options.solver = solver_kind;
    EXPECT(HP_OK, "", hp_paths_create(&image, NULL, source, 1, end, 1, &options, &once));
    EXPECT(HP_OK, "", hp_solver_create(&image, NULL, &options, &solver));
    EXPECT(HP_OK, "", hp_solver_paths_create(solver, source, 1, end, 1, &options, &prepared));
    memset(infos, 0, sizeof infos);
    infos[0].struct_size = infos[1].struct_size = sizeof *infos;
    EXPECT(HP_OK, "", hp_paths_info(once, 0, &infos[0]));
    EXPECT(HP_OK, "", hp_paths_info(prepared, 0, &infos[1]));
    CHECK(infos[0].ending == HP_ENDED_SOURCE && memcmp(&infos[0], &infos[1], sizeof *infos) == 0);
    EXPECT(HP_OK, "", hp_paths_points(once, 0, points[0], PIXELS));
    EXPECT(HP_OK, "", hp_paths_points(prepared, 0, points[1], PIXELS));
    CHECK(memcmp(points[0], points[1], sizeof points[0]) == 0);
    hp_paths_free(once);
    hp_paths_free(prepared);
    EXPECT(HP_INVALID_POINT, "end 0 at [-1.0, 0.0]",
           hp_solver_paths_create(solver, source, 1, outside, 1, &options, &once));
    hp_solver_free(solver);
    EXPECT(HP_INVALID_ARGUMENT, "solver is NULL",
           hp_solver_paths_create(NULL, source, 1, end, 1, &options, &once));
    CHECK(once == NULL);
}

static void wrong_options_fail_in_words(void)
{
    static double speed[PIXELS];
    hp_buffer target = buffer_of(speed, HP_F64);
    hp_options options = defaults();
    double scales[2] = {2, -3};
#define REFUSES(words) \
    EXPECT(HP_INVALID_ARGUMENT, words, hp_medium(&image, NULL, source, 1, &options, &target))
    options.medium = 10;
    REFUSES("medium is 10");
    options.medium = HP_MEDIUM_VESSELNESS, options.scale_count = 2;
    REFUSES("scales is NULL");
    options.scales = scales;
    REFUSES("scale");
    options.scale_count = 65;
    REFUSES("at most 64");
    options.medium = HP_MEDIUM_TENSOR, options.scale_count = 2;
    REFUSES("HP_MEDIUM_TENSOR takes one scale");
    options.scale_count = 0, options.directions = 3;
    REFUSES("directions is 3");
    options.directions = 0, options.polarity = 4;
    REFUSES("polarity is 4");
    options.polarity = 0, options.anisotropy = 1;
    REFUSES("anisotropy");
    options.anisotropy = 0, options.normalize = -1;
    REFUSES("normalize is -1");
    options.normalize = 0, options.margin = NAN;
    REFUSES("margin is NaN");
    options.margin = 0, options.medium = HP_MEDIUM_CONDUCTIVITY;
    EXPECT(HP_INVALID_ARGUMENT, "reference is not set",
           hp_medium(&image, NULL, NULL, 0, &options, &target));
    target.type = HP_U8;
    EXPECT(HP_INVALID_BUFFER, "squared_speed", hp_medium(&image, NULL, source, 1, &options, &target));
}

int main(void)
{
    int i;
    for (i = 0; i < PIXELS; i++)
        band[i] = (uint8_t)(255 * grey(i % WIDTH, i / WIDTH));
    image = buffer_of(band, HP_U8);
    conductivity_is_as_the_header_says();
    tubes_are_fast();
    scales_are_found();
    directions_are_as_the_header_says();
    walls_can_be_thicker();
    the_heat_method_gives_lengths();
    prepared_paths_are_the_same(HP_NORMALIZED, HP_SOLVER_EXPLICIT);
    prepared_paths_are_the_same(HP_NORMALIZED, HP_SOLVER_IMPLICIT);
    prepared_paths_are_the_same(HP_EIKONAL, HP_SOLVER_EXPLICIT);
    wrong_options_fail_in_words();
    return failures != 0;
}
