/* Wrong points, pixels and options, and cancelling: each call must fail in words, without a trace. */
#include "check.h"

static double image_data[PIXELS], distance_data[PIXELS], mask_data[PIXELS];
static hp_buffer image, distance, mask;
static const double source[2] = {3, 4}, end[2] = {20, 15}, pair[4] = {3, 4, 20, 15};

/* The call must fail, and a failed call must leave its results alone. */
static void refuse(int line, const hp_buffer *picture, const double *from, const double *to,
                   const hp_options *options, hp_status status, const char *words)
{
    hp_paths *paths = (hp_paths *)image_data;
    int i;
    for (i = 0; i < PIXELS; i++)
        distance_data[i] = 42;
    if (to == end)
        expect(line, "distance", hp_distance(picture, &mask, from, 1, options, &distance), status,
               words);
    expect(line, "paths", hp_paths_create(picture, &mask, from, 1, to, 1, options, &paths), status,
           words);
    for (i = 0; i < PIXELS; i++)
        CHECK(distance_data[i] == 42);
    CHECK(paths == NULL);
}

static void wrong_points(void)
{
    const double bad[][2] = {{NAN, 4}, {3, INFINITY}, {-0.6, 4}, {WIDTH - 0.4, 4}, {3, 1e300}};
    const double in_wall[2] = {10, 2}, one_in_wall[4] = {3, 4, 10, 2};
    hp_paths *paths;
    size_t i;
    for (i = 0; i < sizeof bad / sizeof *bad; i++) {
        refuse(__LINE__, &image, bad[i], end, NULL, HP_INVALID_POINT, "source 0 at");
        refuse(__LINE__, &image, source, bad[i], NULL, HP_INVALID_POINT, "end 0 at");
    }
    refuse(__LINE__, &image, in_wall, end, NULL, HP_INVALID_POINT, "inside a wall");
    refuse(__LINE__, &image, source, in_wall, NULL, HP_INVALID_POINT, "inside a wall");
    EXPECT(HP_INVALID_POINT, "source 1", hp_distance(&image, &mask, one_in_wall, 2, NULL, &distance));
    EXPECT(HP_INVALID_POINT, "end 1",
           hp_paths_create(&image, &mask, source, 1, one_in_wall, 2, NULL, &paths));
    EXPECT(HP_INVALID_POINT, "no source", hp_distance(&image, NULL, source, 0, NULL, &distance));
    EXPECT(HP_INVALID_POINT, "no source", hp_distance(&image, NULL, NULL, 0, NULL, &distance));
    EXPECT(HP_INVALID_POINT, "no end", hp_paths_create(&image, NULL, source, 1, NULL, 0, NULL, &paths));
    EXPECT(HP_INVALID_ARGUMENT, "points",
           hp_distance(&image, NULL, source, UINT64_MAX, NULL, &distance));
    EXPECT(HP_OUT_OF_MEMORY, "points",
           hp_distance(&image, NULL, source, UINT64_MAX / 64, NULL, &distance));
}

static void wrong_pixels(void)
{
    hp_options options = defaults();
    const double bad[] = {NAN, INFINITY, -INFINITY};
    size_t i;
    for (i = 0; i < sizeof bad / sizeof *bad; i++) {
        image_data[WIDTH + 2] = bad[i];
        refuse(__LINE__, &image, source, end, NULL, HP_INVALID_IMAGE, "image: the value at [2, 1] is");
        options.medium = HP_MEDIUM_GIVEN;
        refuse(__LINE__, &image, source, end, &options, HP_INVALID_IMAGE, "[2, 1]");
        options.medium = HP_MEDIUM_UNIFORM;
        EXPECT(HP_OK, "", hp_distance(&image, NULL, source, 1, &options, &distance));
    }
    options.medium = HP_MEDIUM_GIVEN;
    image_data[WIDTH + 2] = 0;
    refuse(__LINE__, &image, source, end, &options, HP_INVALID_IMAGE, "positive everywhere");
    image_data[WIDTH + 2] = 0.5;
    mask_data[5] = NAN;
    refuse(__LINE__, &image, source, end, NULL, HP_INVALID_IMAGE, "mask: the value at [5, 0]");
    mask_data[5] = 1;
}

#define REFUSE(medium_, field, value, status, words)                                               \
    do {                                                                                           \
        hp_options options = defaults();                                                           \
        options.medium = (medium_);                                                                \
        options.field = (value);                                                                   \
        refuse(__LINE__, &image, source, end, &options, (status), (words));                        \
    } while (0)

static void wrong_options(void)
{
    hp_options options = defaults();
    REFUSE(0, threads, 1, HP_INVALID_ARGUMENT, "medium is 0");
    REFUSE(10, threads, 1, HP_INVALID_ARGUMENT, "medium is 10");
    REFUSE(HP_MEDIUM_COMBINED, edge_stop, 0, HP_INVALID_ARGUMENT, "edge_stop is 0");
    REFUSE(HP_MEDIUM_EDGES, form, 3, HP_INVALID_ARGUMENT, "form is 3");
    REFUSE(HP_MEDIUM_UNIFORM, estimator, 0, HP_INVALID_ARGUMENT, "estimator is 0");
    REFUSE(HP_MEDIUM_GIVEN_TENSOR, threads, 1, HP_INVALID_ARGUMENT, "tensor is NULL");
    REFUSE(HP_MEDIUM_GIVEN_TENSOR, tensor, source, HP_INVALID_ARGUMENT, "tensor_count is 0");
    REFUSE(HP_MEDIUM_UNIFORM, threads, 5000, HP_INVALID_ARGUMENT, "at most 1024");
    REFUSE(HP_MEDIUM_CONDUCTIVITY, power, -1, HP_INVALID_ARGUMENT, "power is -1");
    REFUSE(HP_MEDIUM_CONDUCTIVITY, floor, INFINITY, HP_INVALID_ARGUMENT, "floor is inf");
    REFUSE(HP_MEDIUM_PERONA_MALIK, contrast, 0, HP_INVALID_ARGUMENT, "contrast is 0");
    REFUSE(HP_MEDIUM_COMBINED, smoothing, -1, HP_INVALID_ARGUMENT, "smoothing");
    REFUSE(HP_MEDIUM_EDGES, smoothing, INFINITY, HP_INVALID_ARGUMENT, "smoothing");
    REFUSE(HP_MEDIUM_EDGES, range_low, 5, HP_INVALID_ARGUMENT, "range");
    REFUSE(HP_MEDIUM_EDGES, range_high, INFINITY, HP_INVALID_ARGUMENT, "range");
    REFUSE(HP_MEDIUM_UNIFORM, step, -0.1, HP_INVALID_ARGUMENT, "step is -0.1");
    REFUSE(HP_MEDIUM_UNIFORM, step, INFINITY, HP_UNSTABLE_STEP, "largest stable step");
    REFUSE(HP_MEDIUM_UNIFORM, step, 0.3, HP_UNSTABLE_STEP, "largest stable step in this medium is 0.25");
    REFUSE(HP_MEDIUM_UNIFORM, time, -3, HP_INVALID_ARGUMENT, "time is -3");
    REFUSE(HP_MEDIUM_UNIFORM, time, INFINITY, HP_INVALID_ARGUMENT, "time is inf");
    options.iterations = 5;
    options.time = 3;
    refuse(__LINE__, &image, source, end, &options, HP_INVALID_ARGUMENT, "one of them must be 0");
}

struct watcher {
    int calls, stop_at;
    double last;
};

static int watch(double finished, void *user)
{
    struct watcher *watcher = user;
    CHECK(finished >= watcher->last && finished <= 1);
    watcher->last = finished;
    return ++watcher->calls == watcher->stop_at;
}

/* How often a computation of distances, or of paths, asks whether to go on. */
static int calls(int of_paths, int stop_at, hp_status wanted)
{
    struct watcher watcher = {0, 0, 0};
    hp_options options = defaults();
    hp_paths *paths = (hp_paths *)image_data;
    watcher.stop_at = stop_at;
    options.progress = watch;
    options.user = &watcher;
    options.threads = 2;
    distance_data[0] = 42;
    if (of_paths)
        EXPECT(wanted, "progress callback",
               hp_paths_create(&image, &mask, pair, 2, pair, 2, &options, &paths));
    else
        EXPECT(wanted, "progress callback", hp_distance(&image, &mask, pair, 2, &options, &distance));
    CHECK(wanted != HP_OK || watcher.last == 1);
    CHECK(!of_paths || (paths == NULL) == (wanted != HP_OK));
    CHECK(of_paths || (distance_data[0] == 42) == (wanted != HP_OK));
    if (of_paths)
        hp_paths_free(paths);
    return watcher.calls;
}

/* It can be cancelled each time, and then stops at once. */
static void cancelling(void)
{
    int of_paths, stop_at;
    for (of_paths = 0; of_paths < 2; of_paths++) {
        const int all = calls(of_paths, 0, HP_OK);
        CHECK(all > 5);
        for (stop_at = 1; stop_at <= all; stop_at++)
            CHECK(calls(of_paths, stop_at, HP_CANCELLED) == stop_at);
    }
}

int main(void)
{
    int i;
    for (i = 0; i < PIXELS; i++) {
        image_data[i] = grey(i % WIDTH, i / WIDTH);
        mask_data[i] = i % WIDTH != 10 || i / WIDTH > 12;
    }
    image = buffer_of(image_data, HP_F64);
    distance = buffer_of(distance_data, HP_F64);
    mask = buffer_of(mask_data, HP_F64);
    wrong_points();
    wrong_pixels();
    wrong_options();
    cancelling();
    return failures != 0;
}
