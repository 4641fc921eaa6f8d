/* Whatever a caller says about a volume: a status and a message, and no harm. */
#include "check.h"

enum { DEPTH = 5, VOXELS = PIXELS * DEPTH };

static double image_data[VOXELS], mask_data[VOXELS], distance_data[VOXELS];
static hp_buffer image, mask, distance;
static const double source[3] = {3, 4, 1}, end[3] = {20, 15, 3.5};

static hp_buffer volume_of(void *data, uint32_t type)
{
    hp_buffer buffer = buffer_of(data, type);
    buffer.dimension = 3;
    buffer.size[2] = DEPTH;
    buffer.spacing[2] = 2.5;
    return buffer;
}

/* The volume described as `bad` must be refused, as input and as output. */
static void refuse(int line, hp_buffer bad, hp_status status, const char *words)
{
    hp_paths *paths = NULL;
    expect(line, "as image", hp_distance(&bad, NULL, source, 1, NULL, &distance), status, words);
    expect(line, "as mask", hp_distance(&image, &bad, source, 1, NULL, &distance), status, words);
    expect(line, "as distance", hp_distance(&image, NULL, source, 1, NULL, &bad), status, words);
    expect(line, "for paths", hp_paths_create(&bad, NULL, source, 1, end, 1, NULL, &paths), status,
           words);
    CHECK(paths == NULL);
}

#define REFUSE(field, value, words)                                                                \
    do {                                                                                           \
        hp_buffer bad = image;                                                                     \
        bad.field = (value);                                                                       \
        refuse(__LINE__, bad, HP_INVALID_BUFFER, (words));                                         \
    } while (0)

static void wrong_descriptions(void)
{
    REFUSE(size[2], 0, "axis 2");
    REFUSE(size[2], UINT64_MAX, "too large");
    REFUSE(size[2], (uint64_t)1 << 55, "too large");
    REFUSE(spacing[2], 0, "spacing along axis 2");
    REFUSE(spacing[2], -1, "spacing along axis 2");
    REFUSE(spacing[2], NAN, "NaN");
    REFUSE(spacing[2], INFINITY, "inf");
    REFUSE(byte_stride[2], PIXELS * 8 - 1, "byte_stride[2]");
    REFUSE(byte_stride[2], -PIXELS * 8 + 1, "byte_stride[2]");
    REFUSE(byte_stride[2], 8, "overlap");
    REFUSE(byte_stride[2], INT64_MAX, "outside");
    REFUSE(byte_stride[2], INT64_MIN, "outside");
    REFUSE(byte_stride[1], INT64_MAX / 2, "byte_stride[1]");
    REFUSE(byte_stride[0], INT64_MIN, "byte_stride[0]");
    REFUSE(data, NULL, "data is NULL");
}

static void wrong_companions(void)
{
    hp_buffer bad = volume_of(distance_data, HP_F64);
    const double outside[3] = {3, 4, 5}, nowhere[3] = {3, 4, NAN};
    hp_paths *paths = NULL;
    bad.dimension = 2;
    EXPECT(HP_INVALID_BUFFER, "distance: dimension is 2, but that of the image is 3",
           hp_distance(&image, NULL, source, 1, NULL, &bad));
    EXPECT(HP_INVALID_BUFFER, "mask: dimension is 2", hp_distance(&image, &bad, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_BUFFER, "that of the image is 2", hp_distance(&bad, NULL, source, 1, NULL, &distance));
    bad.dimension = 3;
    bad.size[2] = DEPTH - 1;
    EXPECT(HP_INVALID_BUFFER, "[24, 18, 4]", hp_distance(&image, NULL, source, 1, NULL, &bad));
    EXPECT(HP_INVALID_BUFFER, "[24, 18, 4]", hp_distance(&image, &bad, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_POINT, "[3.0, 4.0, 5.0]", hp_distance(&image, NULL, outside, 1, NULL, &distance));
    EXPECT(HP_INVALID_POINT, "NaN", hp_distance(&image, NULL, nowhere, 1, NULL, &distance));
    EXPECT(HP_INVALID_POINT, "end 0", hp_paths_create(&image, NULL, source, 1, outside, 1, NULL, &paths));
    EXPECT(HP_INVALID_ARGUMENT, "more than memory", hp_distance(&image, NULL, source, UINT64_MAX / 20, NULL, &distance));
    mask_data[PIXELS + WIDTH + 2] = NAN;
    EXPECT(HP_INVALID_IMAGE, "mask: the value at [2, 1, 1]", hp_distance(&image, &mask, source, 1, NULL, &distance));
    mask_data[PIXELS + WIDTH + 2] = 1;
    bad = image;
    bad.size[0] = bad.size[1] = bad.size[2] = (uint64_t)1 << 14;
    EXPECT(HP_OUT_OF_MEMORY, "16384 x 16384 x 16384", hp_distance(&bad, NULL, source, 1, NULL, &distance));
}

/* Layouts that are no mistake. */
static void odd_layouts(void)
{
    static double turned[VOXELS], result[VOXELS];
    hp_buffer other = volume_of(turned, HP_F64);
    int x, y, z;
    for (z = 0; z < DEPTH; z++)
        for (y = 0; y < HEIGHT; y++)
            for (x = 0; x < WIDTH; x++)
                turned[(x * HEIGHT + y) * DEPTH + z] = image_data[(z * HEIGHT + y) * WIDTH + x];
    EXPECT(HP_OK, "", hp_distance(&image, &mask, source, 1, NULL, &distance));
    CHECK(distance_data[PIXELS + 4 * WIDTH + 3] == 0 && distance_data[VOXELS - 1] > 10);
    /* Slices next to each other, as arrays of Fortran have it. */
    other.byte_stride[0] = HEIGHT * DEPTH * sizeof(double);
    other.byte_stride[1] = DEPTH * sizeof(double);
    other.byte_stride[2] = sizeof(double);
    {
        hp_buffer target = volume_of(result, HP_F64);
        EXPECT(HP_OK, "", hp_distance(&other, NULL, source, 1, NULL, &target));
        CHECK(memcmp(result, distance_data, sizeof result) == 0);
        /* Upside down, in place. */
        memcpy(result, image_data, sizeof result);
        for (z = 0; z < DEPTH; z++)
            memcpy(result + (DEPTH - 1 - z) * PIXELS, image_data + z * PIXELS, PIXELS * sizeof(double));
        target.data = result + (DEPTH - 1) * PIXELS;
        target.byte_stride[2] = -(int64_t)(PIXELS * sizeof(double));
        EXPECT(HP_OK, "", hp_distance(&target, NULL, source, 1, NULL, &target));
        for (z = 0; z < DEPTH; z++)
            CHECK(memcmp(result + (DEPTH - 1 - z) * PIXELS, distance_data + z * PIXELS,
                         PIXELS * sizeof(double)) == 0);
    }
}

/* The default step is 0.2 in pictures and 2/15 in volumes. */
static void steps(void)
{
    static double result[VOXELS];
    hp_buffer target = volume_of(result, HP_F64);
    hp_options options = defaults();
    CHECK(options.step != options.step);
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    options.step = 0.8 / 6;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &target));
    CHECK(memcmp(result, distance_data, sizeof result) == 0);
    options.medium = HP_MEDIUM_UNIFORM;
    options.step = 0.2;
    image.spacing[2] = 1;
    EXPECT(HP_UNSTABLE_STEP, "0.1666", hp_distance(&image, NULL, source, 1, &options, &target));
    image.spacing[2] = 2.5;
    image.dimension = distance.dimension = target.dimension = 2;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &target));
    options.step = NAN;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    CHECK(memcmp(result, distance_data, PIXELS * sizeof(double)) == 0);
    image.dimension = distance.dimension = 3;
}

int main(void)
{
    int i;
    for (i = 0; i < VOXELS; i++) {
        image_data[i] = grey(i % WIDTH, i / WIDTH % HEIGHT) + 0.02 * (i / PIXELS);
        mask_data[i] = 1;
    }
    image = volume_of(image_data, HP_F64);
    mask = volume_of(mask_data, HP_F64);
    distance = volume_of(distance_data, HP_F64);
    wrong_descriptions();
    wrong_companions();
    odd_layouts();
    steps();
    return failures != 0;
}
