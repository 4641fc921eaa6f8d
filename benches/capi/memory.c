/* How much memory a call of hp_distance takes beside the caller's image and result.
 *
 *     memory TYPE SIDE ESTIMATOR
 *
 * Makes a picture of SIDE x SIDE pixels of a type (1 is HP_U8, 8 is HP_F64), computes ten steps of heat
 * or, with ESTIMATOR 3, exact distances, and prints by how many bytes a pixel the peak of the process
 * (VmHWM) has risen.
 */
#include <heatpath.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The most memory the process has had so far, in bytes. */
static double peak(void)
{
    char line[256];
    double kilobytes = 0;
    FILE *status = fopen("/proc/self/status", "r");
    while (status && fgets(line, sizeof line, status))
        if (strncmp(line, "VmHWM:", 6) == 0)
            kilobytes = atof(line + 6);
    if (status)
        fclose(status);
    return 1024 * kilobytes;
}

static hp_buffer describe(uint32_t type, size_t bytes, uint64_t side)
{
    hp_buffer buffer;
    hp_buffer_init(&buffer, sizeof buffer);
    buffer.type = type;
    buffer.size[0] = buffer.size[1] = side;
    buffer.data = malloc(bytes * side * side);
    if (buffer.data)
        memset(buffer.data, 0, bytes * side * side); /* now it is there, and counted */
    return buffer;
}

int main(int count, char **arguments)
{
    static const size_t bytes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    const uint32_t type = count == 4 ? (uint32_t)atoi(arguments[1]) : 0;
    const uint64_t side = count == 4 ? (uint64_t)atoi(arguments[2]) : 0;
    const double source[2] = {3, 4};
    hp_buffer image, distances;
    hp_options options;
    double before;
    if (type < HP_U8 || type > HP_F64 || side < 16) {
        fprintf(stderr, "usage: memory TYPE SIDE ESTIMATOR\n");
        return 2;
    }
    image = describe(type, bytes[type], side);
    distances = describe(HP_F64, 8, side);
    hp_options_init(&options, sizeof options);
    options.iterations = 10;
    options.threads = 1;
    options.estimator = (uint32_t)atoi(arguments[3]);
    before = peak();
    if (hp_distance(&image, NULL, source, 1, &options, &distances) != HP_OK) {
        fprintf(stderr, "%s\n", hp_last_error_message());
        return 1;
    }
    printf("%.1f\n", (peak() - before) / (double)(side * side));
    free(image.data);
    free(distances.data);
    return 0;
}
