/* Wrong pointers, struct sizes and descriptions: each call must fail in words, and none may crash. */
#include "check.h"

static double image_data[PIXELS], distance_data[PIXELS];
static hp_buffer image, distance;
static const double source[2] = {3, 4}, end[2] = {20, 15};

static void wrong_pointers(void)
{
    hp_paths *paths = (hp_paths *)image_data;
    double unaligned[16];
    hp_buffer *odd = (hp_buffer *)(void *)((char *)unaligned + 1);
    hp_buffer empty = buffer_of(NULL, HP_F64);
    EXPECT(HP_INVALID_ARGUMENT, "image is NULL", hp_distance(NULL, NULL, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "distance is NULL", hp_distance(&image, NULL, source, 1, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "sources", hp_distance(&image, NULL, NULL, 1, NULL, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "multiple", hp_distance(odd, NULL, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "mask", hp_distance(&image, odd, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "options",
           hp_distance(&image, NULL, source, 1, (hp_options *)(void *)odd, &distance));
    EXPECT(HP_INVALID_BUFFER, "image: data", hp_distance(&empty, NULL, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_BUFFER, "distance: data", hp_distance(&image, NULL, source, 1, NULL, &empty));
    EXPECT(HP_INVALID_BUFFER, "mask: data", hp_distance(&image, &empty, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_ARGUMENT, "paths", hp_paths_create(&image, NULL, source, 1, end, 1, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "ends", hp_paths_create(&image, NULL, source, 1, NULL, 1, NULL, &paths));
    CHECK(paths == NULL);
    EXPECT(HP_INVALID_ARGUMENT, "buffer is NULL", hp_buffer_init(NULL, sizeof image));
    EXPECT(HP_INVALID_ARGUMENT, "options is NULL", hp_options_init(NULL, sizeof(hp_options)));
    EXPECT(HP_INVALID_ARGUMENT, "multiple", hp_buffer_init(odd, sizeof image));
}

static void wrong_struct_sizes(void)
{
    struct {
        hp_options known;
        char later[16];
    } longer;
    hp_options options = defaults();
    hp_buffer bad = image;
    const uint32_t sizes[] = {0, 4, 12, sizeof options + 1, 5000, UINT32_MAX};
    size_t i;
    for (i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        bad.struct_size = options.struct_size = sizes[i];
        EXPECT(HP_INVALID_ARGUMENT, "struct_size",
               hp_distance(&bad, NULL, source, 1, NULL, &distance));
        EXPECT(HP_INVALID_ARGUMENT, "struct_size",
               hp_distance(&image, NULL, source, 1, &options, &distance));
        EXPECT(HP_INVALID_ARGUMENT, "struct_size", hp_options_init(&options, sizes[i]));
    }

    /* An older header: what it does not know is left alone and has its default. */
    options = defaults();
    memset(&options.power, 0xff, sizeof options - 8);
    options.struct_size = 8;
    options.medium = HP_MEDIUM_UNIFORM;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    EXPECT(HP_OK, "", hp_options_init(&options, 8));
    CHECK(options.struct_size == 8 && options.power != options.power);

    /* A newer header: what the library does not know must be zero. */
    memset(&longer, 0xff, sizeof longer);
    EXPECT(HP_OK, "", hp_options_init(&longer.known, sizeof longer));
    CHECK(longer.known.struct_size == sizeof longer && longer.later[15] == 0);
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &longer.known, &distance));
    longer.later[15] = 1;
    EXPECT(HP_INVALID_ARGUMENT, "not zero",
           hp_distance(&image, NULL, source, 1, &longer.known, &distance));
}

/* The image described as `bad` must be refused, as input and as output. */
static void refuse(int line, hp_buffer bad, hp_status status, const char *words)
{
    expect(line, "as image", hp_distance(&bad, NULL, source, 1, NULL, &distance), status, words);
    expect(line, "as mask", hp_distance(&image, &bad, source, 1, NULL, &distance), status, words);
    expect(line, "as distance", hp_distance(&image, NULL, source, 1, NULL, &bad), status, words);
}

#define REFUSE(field, value, status, words)                                                        \
    do {                                                                                           \
        hp_buffer bad = image;                                                                     \
        bad.field = (value);                                                                       \
        refuse(__LINE__, bad, (status), (words));                                                  \
    } while (0)

static void wrong_descriptions(void)
{
    hp_buffer bad;
    REFUSE(type, 0, HP_INVALID_BUFFER, "type is 0");
    REFUSE(type, 99, HP_INVALID_BUFFER, "type is 99");
    REFUSE(dimension, 0, HP_INVALID_BUFFER, "dimension is 0");
    REFUSE(dimension, 1, HP_INVALID_BUFFER, "it must be 2 or 3");
    REFUSE(dimension, 4, HP_INVALID_BUFFER, "dimension is 4");
    REFUSE(dimension, UINT32_MAX, HP_INVALID_BUFFER, "dimension is 4294967295");
    REFUSE(reserved, 1, HP_INVALID_BUFFER, "reserved");
    REFUSE(size[0], 0, HP_INVALID_BUFFER, "axis 0");
    REFUSE(size[1], 0, HP_INVALID_BUFFER, "axis 1");
    REFUSE(size[0], UINT64_MAX, HP_INVALID_BUFFER, "too large");
    REFUSE(size[1], (uint64_t)1 << 60, HP_INVALID_BUFFER, "too large");
    REFUSE(spacing[0], 0, HP_INVALID_BUFFER, "spacing along axis 0");
    REFUSE(spacing[1], -2, HP_INVALID_BUFFER, "spacing along axis 1");
    REFUSE(spacing[1], NAN, HP_INVALID_BUFFER, "NaN");
    REFUSE(byte_stride[0], 4, HP_INVALID_BUFFER, "byte_stride[0] is 4");
    REFUSE(byte_stride[1], WIDTH, HP_INVALID_BUFFER, "overlap");
    REFUSE(byte_stride[1], INT64_MAX, HP_INVALID_BUFFER, "outside");
    REFUSE(byte_stride[1], INT64_MIN, HP_INVALID_BUFFER, "outside");
    REFUSE(byte_stride[0], INT64_MIN, HP_INVALID_BUFFER, "byte_stride[0]");

    bad = image;
    bad.size[0] = bad.size[1] = (uint64_t)1 << 20;
    EXPECT(HP_OUT_OF_MEMORY, "1048576 x 1048576", hp_distance(&bad, NULL, source, 1, NULL, &distance));
    bad = image;
    bad.size[1] = HEIGHT - 1;
    EXPECT(HP_INVALID_BUFFER, "mask has [24, 17]", hp_distance(&image, &bad, source, 1, NULL, &distance));
    EXPECT(HP_INVALID_BUFFER, "[24, 17]", hp_distance(&image, NULL, source, 1, NULL, &bad));
    bad = buffer_of(distance_data, HP_I32);
    EXPECT(HP_INVALID_BUFFER, "HP_F32 or HP_F64", hp_distance(&image, NULL, source, 1, NULL, &bad));
}

static void wrong_use_of_paths(void)
{
    hp_paths *paths = NULL;
    hp_path_info info;
    double xy[2 * PIXELS];
    uint64_t count = 7;
    hp_options options = defaults();
    hp_paths_free(NULL);
    EXPECT(HP_INVALID_ARGUMENT, "paths is NULL", hp_paths_count(NULL, &count));
    EXPECT(HP_INVALID_ARGUMENT, "paths is NULL", hp_paths_info(NULL, 0, &info));
    EXPECT(HP_INVALID_ARGUMENT, "paths is NULL", hp_paths_points(NULL, 0, xy, PIXELS));
    EXPECT(HP_OK, "", hp_paths_create(&image, NULL, source, 1, end, 1, &options, &paths));
    EXPECT(HP_INVALID_ARGUMENT, "count is NULL", hp_paths_count(paths, NULL));
    EXPECT(HP_OK, "", hp_paths_count(paths, &count));
    CHECK(count == 1);
    EXPECT(HP_INVALID_ARGUMENT, "info is NULL", hp_paths_info(paths, 0, NULL));
    info.struct_size = 3;
    EXPECT(HP_INVALID_ARGUMENT, "struct_size", hp_paths_info(paths, 0, &info));
    info.struct_size = 8;
    info.source = 42;
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    CHECK(info.ending == HP_ENDED_SOURCE && info.source == 42);
    info.struct_size = sizeof info;
    EXPECT(HP_INVALID_ARGUMENT, "path 1", hp_paths_info(paths, 1, &info));
    EXPECT(HP_INVALID_ARGUMENT, "path 18446744073709551615", hp_paths_info(paths, UINT64_MAX, &info));
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    CHECK(info.source == 0 && info.point_count > 20 && info.length > 20 && info.distance > 20);
    EXPECT(HP_INVALID_ARGUMENT, "coordinates is NULL", hp_paths_points(paths, 0, NULL, PIXELS));
    EXPECT(HP_INVALID_ARGUMENT, "capacity is 3", hp_paths_points(paths, 0, xy, 3));
    EXPECT(HP_INVALID_ARGUMENT, "path 1", hp_paths_points(paths, 1, xy, PIXELS));
    EXPECT(HP_OK, "", hp_paths_points(paths, 0, xy, info.point_count));
    CHECK(xy[0] == end[0] && xy[1] == end[1]);
    CHECK(xy[2 * info.point_count - 2] == source[0] && xy[2 * info.point_count - 1] == source[1]);
    hp_paths_free(paths);
}

int main(void)
{
    int i;
    CHECK(strcmp(hp_last_error_message(), "") == 0);
    CHECK(hp_abi_version() == HP_ABI_VERSION);
    CHECK(strcmp(hp_version_string(), HP_VERSION_STRING) == 0);
    CHECK(strcmp(hp_status_name(HP_INVALID_POINT), "HP_INVALID_POINT") == 0);
    CHECK(strcmp(hp_status_name(-1), "unknown status") == 0);
    for (i = 0; i < PIXELS; i++)
        image_data[i] = grey(i % WIDTH, i / WIDTH);
    image = buffer_of(image_data, HP_F64);
    distance = buffer_of(distance_data, HP_F64);
    wrong_pointers();
    wrong_struct_sizes();
    wrong_descriptions();
    wrong_use_of_paths();
    return failures != 0;
}
