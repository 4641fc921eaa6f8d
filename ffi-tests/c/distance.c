/* Distances and a path on a grey picture.
 *
 *     distance PICTURE.pgm X Y DISTANCES [END_X END_Y]
 *
 * Writes the distance of every pixel from pixel X, Y to the file DISTANCES, as doubles, row by row.
 * If an end is given, prints the path from there to X, Y, one point a line.
 *
 *     cc distance.c -lheatpath
 */
#include "heatpath.h"

#include <stdio.h>
#include <stdlib.h>

/* Reads a PGM file (P5) of 8 bits a pixel; returns NULL if it is none. */
static unsigned char *read_pgm(const char *name, unsigned *width, unsigned *height)
{
    unsigned char *pixels = NULL;
    unsigned white = 0;
    FILE *file = fopen(name, "rb");
    if (!file)
        return NULL;
    if (fscanf(file, "P5 %u %u %u", width, height, &white) == 3 && white == 255 && *width > 0 &&
        *height > 0 && *height <= 0x7fffffff / *width && fgetc(file) != EOF) {
        size_t count = (size_t)*width * *height;
        pixels = malloc(count);
        if (pixels && fread(pixels, 1, count, file) != count) {
            free(pixels);
            pixels = NULL;
        }
    }
    fclose(file);
    return pixels;
}

/* Says what was wrong; the message is that of the last call that failed on this thread. */
static int report(const char *what, hp_status status)
{
    fprintf(stderr, "%s: %s: %s\n", what, hp_status_name(status), hp_last_error_message());
    return EXIT_FAILURE;
}

/* Describes pixels that follow each other without gaps. */
static hp_buffer describe(void *data, uint32_t type, unsigned width, unsigned height)
{
    hp_buffer buffer;
    hp_buffer_init(&buffer, sizeof buffer);
    buffer.data = data;
    buffer.type = type;
    buffer.size[0] = width;
    buffer.size[1] = height;
    return buffer;
}

static int write_distances(const hp_buffer *image, const double *source, const char *name)
{
    size_t count = (size_t)(image->size[0] * image->size[1]);
    double *distances = malloc(count * sizeof *distances);
    hp_buffer target = describe(distances, HP_F64, (unsigned)image->size[0],
                                (unsigned)image->size[1]);
    int result = EXIT_SUCCESS;
    hp_status status = hp_distance(image, NULL, source, 1, NULL, &target);
    if (status != HP_OK) {
        result = report("distance", status);
    } else {
        FILE *file = fopen(name, "wb");
        if (!file || fwrite(distances, sizeof *distances, count, file) != count)
            result = EXIT_FAILURE;
        if (file && fclose(file) != 0)
            result = EXIT_FAILURE;
        if (result != EXIT_SUCCESS)
            fprintf(stderr, "%s cannot be written\n", name);
    }
    free(distances);
    return result;
}

static void print_path(const hp_paths *paths)
{
    hp_path_info info;
    double *points;
    info.struct_size = sizeof info;
    if (hp_paths_info(paths, 0, &info) != HP_OK)
        return;
    points = malloc((size_t)info.point_count * 2 * sizeof *points);
    if (points && hp_paths_points(paths, 0, points, info.point_count) == HP_OK) {
        uint64_t i;
        for (i = 0; i < info.point_count; i++)
            printf("%.3f %.3f\n", points[2 * i], points[2 * i + 1]);
    }
    free(points);
}

static int trace(const hp_buffer *image, const double *source, const double *end)
{
    hp_paths *paths;
    hp_options options;
    hp_status status;
    hp_options_init(&options, sizeof options);
    options.step = 0; /* the largest safe one */
    status = hp_paths_create(image, NULL, source, 1, end, 1, &options, &paths);
    if (status != HP_OK)
        return report("path", status);
    print_path(paths);
    hp_paths_free(paths);
    return EXIT_SUCCESS;
}

int main(int argc, char **argv)
{
    unsigned width, height;
    unsigned char *pixels;
    double source[2];
    int result;
    if (argc != 5 && argc != 7) {
        fprintf(stderr, "usage: distance PICTURE.pgm X Y DISTANCES [END_X END_Y]\n");
        return EXIT_FAILURE;
    }
    pixels = read_pgm(argv[1], &width, &height);
    if (!pixels) {
        fprintf(stderr, "%s is no PGM file of 8 bits a pixel\n", argv[1]);
        return EXIT_FAILURE;
    }
    source[0] = atof(argv[2]);
    source[1] = atof(argv[3]);
    {
        hp_buffer image = describe(pixels, HP_U8, width, height);
        result = write_distances(&image, source, argv[4]);
        if (result == EXIT_SUCCESS && argc == 7) {
            double end[2];
            end[0] = atof(argv[5]);
            end[1] = atof(argv[6]);
            result = trace(&image, source, end);
        }
    }
    free(pixels);
    return result;
}
