/* What a call of the C library costs on a picture of 16 x 16 pixels: medians of 10,000 calls.
 * bash benches/capi/run
 */
#define _POSIX_C_SOURCE 199309L
#include <heatpath.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SIDE 16
#define CALLS 10000

static hp_buffer image, distances;
static hp_options options;
static hp_solver *solver;

static void check(hp_status status)
{
    if (status != HP_OK) {
        fprintf(stderr, "%s\n", hp_last_error_message());
        exit(EXIT_FAILURE);
    }
}

static void call(void)
{
    const double source[2] = {4, 5.25};
    check(hp_distance(&image, NULL, source, 1, &options, &distances));
}

static void call_prepared(void)
{
    const double source[2] = {4, 5.25};
    check(hp_solver_distances(solver, source, 1, &options, &distances, 0));
}

static double microseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static int compare(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

static void report(const char *name, void (*function)(void))
{
    static double times[CALLS];
    int i;
    for (i = 0; i < CALLS; i++) {
        const double start = microseconds();
        function();
        times[i] = microseconds() - start;
    }
    qsort(times, CALLS, sizeof *times, compare);
    printf("| %-44s | %7.1f |\n", name, times[CALLS / 2]);
}

static hp_buffer describe(void *data, uint32_t type)
{
    hp_buffer buffer;
    check(hp_buffer_init(&buffer, sizeof buffer));
    buffer.data = data;
    buffer.type = type;
    buffer.size[0] = buffer.size[1] = SIDE;
    return buffer;
}

int main(void)
{
    static uint8_t pixels[SIDE * SIDE];
    static double results[SIDE * SIDE];
    int i;
    for (i = 0; i < SIDE * SIDE; i++)
        pixels[i] = (uint8_t)(100 + 37 * i % 101);
    image = describe(pixels, HP_U8);
    distances = describe(results, HP_F64);
    check(hp_options_init(&options, sizeof options));

    printf("| 16 x 16 pixels                               |      us |\n");
    printf("| -------------------------------------------- | ------: |\n");
    report("hp_distance, defaults: 32 steps of heat", call);
    options.threads = 1;
    report("hp_distance, the same with one thread", call);
    options.iterations = 1;
    report("hp_distance, one step of heat", call);
    options.iterations = 0;
    options.estimator = HP_EIKONAL;
    report("hp_distance, HP_EIKONAL", call);
    options.estimator = HP_NORMALIZED;
    options.reference = 0.5;
    check(hp_solver_create(&image, NULL, &options, &solver));
    report("hp_solver_distances, 32 steps of heat", call_prepared);
    hp_solver_free(solver);
    return EXIT_SUCCESS;
}
