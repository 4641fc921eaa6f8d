/* Distances in a volume whose slices do not follow each other without gaps, as in a viewer that
 * shows a part of a larger one.
 *
 *     volume VOLUME WIDTH HEIGHT DEPTH SLICE_DISTANCE X Y Z DISTANCES ESTIMATOR
 *
 * VOLUME holds bytes, slice by slice and row by row. Writes the distance of every voxel from X, Y, Z
 * to the file DISTANCES, as doubles in the same order, and prints the path from the last voxel.
 * ESTIMATOR is a number of the header.
 */
#include "check.h"

#include <stdlib.h>

enum { PADDING = 24, MOST = 64 };

static unsigned size[3];
static double slice_distance;
static hp_options options;

static hp_buffer describe(void *data, uint32_t type, size_t bytes)
{
    hp_buffer buffer = buffer_of(data, type);
    int axis;
    buffer.dimension = 3;
    for (axis = 0; axis < 3; axis++)
        buffer.size[axis] = size[axis];
    buffer.byte_stride[2] = (int64_t)(size[0] * size[1] * bytes + PADDING);
    buffer.spacing[2] = slice_distance;
    return buffer;
}

static size_t bytes_of(const hp_buffer *buffer)
{
    return (size_t)buffer->byte_stride[2] * size[2];
}

/* Reads or writes a file slice by slice, without what is between the slices. */
static int transfer(const char *name, const char *mode, const hp_buffer *buffer, size_t bytes)
{
    size_t slice = (size_t)size[0] * size[1], done = 0;
    unsigned z;
    FILE *file = fopen(name, mode);
    if (!file)
        return 0;
    for (z = 0; z < size[2]; z++) {
        char *data = (char *)buffer->data + z * buffer->byte_stride[2];
        done += mode[0] == 'r' ? fread(data, bytes, slice, file) : fwrite(data, bytes, slice, file);
    }
    return fclose(file) == 0 && done == slice * size[2];
}

static void print_path(const hp_buffer *image, const double *source)
{
    double end[3], points[3 * MOST * MOST];
    hp_path_info info;
    hp_paths *paths;
    uint64_t i;
    for (i = 0; i < 3; i++)
        end[i] = size[i] - 1;
    EXPECT(HP_OK, "", hp_paths_create(image, NULL, source, 1, end, 1, &options, &paths));
    info.struct_size = sizeof info;
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    CHECK(info.ending == HP_ENDED_SOURCE && info.physical_length > info.length);
    EXPECT(HP_INVALID_ARGUMENT, "capacity", hp_paths_points(paths, 0, points, info.point_count - 1));
    EXPECT(HP_OK, "", hp_paths_points(paths, 0, points, MOST * MOST));
    for (i = 0; i < info.point_count; i++)
        printf("%.17g,%.17g,%.17g\n", points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    hp_paths_free(paths);
}

int main(int argc, char **argv)
{
    hp_buffer image, distance;
    double source[3];
    int axis;
    if (argc != 11)
        return 1;
    slice_distance = atof(argv[5]);
    EXPECT(HP_OK, "", hp_options_init(&options, sizeof options));
    options.estimator = (uint32_t)atoi(argv[10]);
    for (axis = 0; axis < 3; axis++) {
        size[axis] = (unsigned)atoi(argv[2 + axis]);
        source[axis] = atof(argv[6 + axis]);
        if (size[axis] == 0 || size[axis] > MOST)
            return 1;
    }
    image = describe(NULL, HP_U8, sizeof(uint8_t));
    distance = describe(NULL, HP_F64, sizeof(double));
    image.data = malloc(bytes_of(&image));
    distance.data = malloc(bytes_of(&distance));
    if (!image.data || !distance.data || !transfer(argv[1], "rb", &image, sizeof(uint8_t)))
        return 1;
    memset(distance.data, 0x55, bytes_of(&distance));
    EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    for (axis = 0; axis < PADDING; axis++)
        CHECK(((char *)distance.data)[size[0] * size[1] * sizeof(double) + axis] == 0x55);
    if (!transfer(argv[9], "wb", &distance, sizeof(double)))
        return 1;
    print_path(&image, source);
    free(image.data);
    free(distance.data);
    return failures != 0;
}
