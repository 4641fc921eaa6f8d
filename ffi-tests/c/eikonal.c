/* Exact distances: in uniform media, beyond walls and limits, along paths, and in given tensors. */
#include "check.h"

enum { DEPTH = 5, CELLS = PIXELS * DEPTH };

static double image_data[CELLS], mask_data[CELLS], distance_data[CELLS], tensor[6 * CELLS];
static hp_buffer image, mask, distance;
static const double source[3] = {3.25, 4.5, 2}, end[3] = {20, 15, 3};

static hp_options exact(uint32_t medium, uint32_t dimension)
{
    hp_options options = defaults();
    options.medium = medium;
    options.estimator = HP_EIKONAL;
    image.dimension = mask.dimension = distance.dimension = dimension;
    return options;
}

/* The square of the length of a step. */
typedef double (*length_sq)(double x, double y, double z);

static double straight(double x, double y, double z)
{
    return x * x + 4 * y * y + 2.25 * z * z;
}

/* Of D = [[4, 1], [1, 2]]. */
static double in_plane(double x, double y, double z)
{
    (void)z;
    return (2 * x * x - 2 * x * y + 4 * y * y) / 7;
}

/* Of D = [[2, 0.5, 0.3], [0.5, 4, 0.2], [0.3, 0.2, 1]]. */
static double in_space(double x, double y, double z)
{
    y *= 2;
    z *= 1.5;
    return (3.96 * x * x + 1.91 * y * y + 7.75 * z * z - 0.88 * x * y - 2.2 * x * z -
            0.5 * y * z) / 7.37;
}

static double worst(length_sq length, uint64_t slices)
{
    double most = 0;
    uint64_t i;
    for (i = 0; i < PIXELS * slices; i++) {
        const double x = (double)(i % WIDTH), y = (double)(i / WIDTH % HEIGHT);
        const double z = slices > 1 ? (double)(i / PIXELS) - source[2] : 0;
        most = fmax(most, fabs(distance_data[i] - sqrt(length(x - source[0], y - source[1], z))));
    }
    return most;
}

static void even_media(void)
{
    hp_options options = exact(HP_MEDIUM_UNIFORM, 2);
    /* These are about heat, and ignored. */
    options.iterations = 5;
    options.time = 3;
    options.step = 77;
    options.solver = 9;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    CHECK(worst(straight, 1) < 1e-8);
    options = exact(HP_MEDIUM_UNIFORM, 3);
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    CHECK(worst(straight, DEPTH) < 1e-8);
}

static void tensors(void)
{
    static const double plane[3] = {4, 1, 2}, space[6] = {2, 0.5, 0.3, 4, 0.2, 1};
    hp_options options = exact(HP_MEDIUM_GIVEN_TENSOR, 2);
    hp_buffer nothing = image;
    int i;
    nothing.data = NULL;
    nothing.spacing[1] = 1;
    for (i = 0; i < 3 * PIXELS; i++)
        tensor[i] = plane[i % 3];
    options.tensor = tensor;
    options.tensor_count = 3 * PIXELS;
    EXPECT(HP_OK, "", hp_distance(&nothing, NULL, source, 1, &options, &distance));
    CHECK(worst(in_plane, 1) < 1e-8);
    options.tensor_count--;
    EXPECT(HP_INVALID_ARGUMENT, "tensor_count is 1295; it must be 3 for each of 432",
           hp_distance(&nothing, NULL, source, 1, &options, &distance));
    options.tensor_count++;
    tensor[3 * (2 * WIDTH + 7) + 1] = 3;
    EXPECT(HP_INVALID_IMAGE, "tensor: the given tensor is [[4.0, 3.0], [3.0, 2.0]] at [7, 2]",
           hp_distance(&nothing, NULL, source, 1, &options, &distance));
    options = exact(HP_MEDIUM_GIVEN_TENSOR, 3);
    nothing.dimension = 3;
    nothing.spacing[1] = 2;
    for (i = 0; i < 6 * CELLS; i++)
        tensor[i] = space[i % 6];
    options.tensor = tensor;
    options.tensor_count = 6 * CELLS;
    EXPECT(HP_OK, "", hp_distance(&nothing, NULL, source, 1, &options, &distance));
    CHECK(worst(in_space, DEPTH) < 1e-8);
}

static void limits(void)
{
    hp_options options = exact(HP_MEDIUM_UNIFORM, 2);
    hp_paths *paths;
    hp_path_info info;
    int i;
    info.struct_size = sizeof info;
    options.farthest = 10;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    for (i = 0; i < PIXELS; i++) {
        const double step = straight(i % WIDTH - source[0], i / WIDTH - source[1], 0);
        CHECK(isfinite(distance_data[i]) == (step <= 100));
    }
    EXPECT(HP_OK, "", hp_paths_create(&image, NULL, source, 1, end, 1, &options, &paths));
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    CHECK(info.ending == HP_ENDED_NOT_REACHED && info.point_count == 1);
    hp_paths_free(paths);
    options.farthest = -1;
    EXPECT(HP_INVALID_ARGUMENT, "farthest is -1; it must be positive",
           hp_distance(&image, NULL, source, 1, &options, &distance));
    options.farthest = NAN;
    EXPECT(HP_INVALID_ARGUMENT, "farthest is NaN",
           hp_paths_create(&image, NULL, source, 1, end, 1, &options, &paths));
}

static void paths_around_walls(uint32_t dimension)
{
    hp_options options = exact(HP_MEDIUM_CONDUCTIVITY, dimension);
    const uint64_t cell = 15 * WIDTH + 20 + (dimension == 3 ? 3 * PIXELS : 0);
    hp_paths *paths;
    hp_path_info info;
    info.struct_size = sizeof info;
    EXPECT(HP_OK, "", hp_distance(&image, &mask, source, 1, &options, &distance));
    CHECK(isinf(distance_data[10]) && isfinite(distance_data[9]));
    EXPECT(HP_OK, "", hp_paths_create(&image, &mask, source, 1, end, 1, &options, &paths));
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    CHECK(info.ending == HP_ENDED_SOURCE && info.source == 0 && info.point_count > 20);
    CHECK(info.distance == distance_data[cell]);
    hp_paths_free(paths);
}

int main(void)
{
    int i;
    for (i = 0; i < CELLS; i++) {
        image_data[i] = grey(i % WIDTH, i / WIDTH % HEIGHT);
        mask_data[i] = i % WIDTH != 10 || i / WIDTH % HEIGHT > 12;
    }
    image = buffer_of(image_data, HP_F64);
    mask = buffer_of(mask_data, HP_F64);
    distance = buffer_of(distance_data, HP_F64);
    image.size[2] = mask.size[2] = distance.size[2] = DEPTH;
    image.spacing[1] = 2;
    image.spacing[2] = 1.5;
    even_media();
    tensors();
    limits();
    paths_around_walls(2);
    paths_around_walls(3);
    return failures != 0;
}
