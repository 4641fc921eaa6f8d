/* Structs with any contents: each call answers with a status, and touches nothing else.
 *
 *     wild [CALLS]
 *
 * For a fuzzer: clang -fsanitize=fuzzer,address -DFUZZER wild.c -lheatpath
 *
 * A caller promises that what is described can be read. So data points into an arena if the
 * description, worked out here once more, lies inside of it, and is NULL otherwise.
 */
#include "heatpath.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ARENA = 1 << 16 };

static unsigned char arena[4][ARENA]; /* image, mask, two results */

/* Bytes to make structs of, of a fuzzer or at random; zeros once they are used up. */
static const uint8_t *bytes;
static size_t bytes_left;

static uint64_t next(void)
{
    uint64_t value = 0;
    size_t n = bytes_left < sizeof value ? bytes_left : sizeof value;
    memcpy(&value, bytes, n);
    bytes += n;
    bytes_left -= n;
    return value;
}

static uint64_t below(uint64_t end)
{
    return next() % end;
}

/* Mostly what makes sense, or nothing would ever be computed. */
static uint64_t usual_or_wild(uint64_t usual)
{
    return below(16) ? usual : next();
}

static double number(void)
{
    static const double some[] = {0, 1, 0.5, 2, -1, 1e-300, 1e300, 40};
    uint64_t bits = next();
    double value;
    switch (below(8)) {
    case 0: return NAN;
    case 1: return below(2) ? INFINITY : -INFINITY;
    case 2: memcpy(&value, &bits, sizeof value); return value;
    default: return some[bits % 8];
    }
}

static int64_t magnitude(int64_t value)
{
    return value < 0 ? -value : value;
}

/* Whether the pixels, from the middle of an arena, stay inside; strides of 0 are the library's to find. */
static int stays_inside(const hp_buffer *buffer, int axes)
{
    int64_t reach = 8, packed = 8;
    int axis;
    for (axis = 0; axis < axes; axis++) {
        int64_t stride = buffer->byte_stride[axis];
        if (buffer->size[axis] > 64 || stride > 4096 || stride < -4096)
            return 0;
        stride = stride ? magnitude(stride) : packed;
        reach += stride * (int64_t)buffer->size[axis];
        if (stride * (int64_t)buffer->size[axis] > packed)
            packed = stride * (int64_t)buffer->size[axis];
    }
    return reach < ARENA / 2;
}

static hp_buffer any_buffer(int place, uint64_t size[3], uint32_t type)
{
    hp_buffer buffer;
    int axis;
    hp_buffer_init(&buffer, sizeof buffer);
    buffer.struct_size = (uint32_t)usual_or_wild(sizeof buffer);
    if (buffer.struct_size > sizeof buffer)
        buffer.struct_size = 0; /* a longer struct would promise more bytes */
    buffer.type = (uint32_t)usual_or_wild(type);
    buffer.dimension = (uint32_t)usual_or_wild(size[2] ? 3 : 2);
    buffer.reserved = (uint32_t)usual_or_wild(0);
    for (axis = 0; axis < 3; axis++) {
        buffer.size[axis] = usual_or_wild(size[axis] ? size[axis] : 1);
        buffer.byte_stride[axis] = below(8) ? 0 : (int64_t)below(300) - 150;
        if (below(40) == 0)
            buffer.byte_stride[axis] = (int64_t)next();
        buffer.spacing[axis] = below(8) ? 1 : number();
    }
    buffer.data = stays_inside(&buffer, 3) ? &arena[place][ARENA / 2 + below(8)] : NULL;
    return buffer;
}

static hp_options any_options(const double *scales)
{
    hp_options options;
    hp_options_init(&options, sizeof options);
    options.struct_size = (uint32_t)usual_or_wild(sizeof options);
    if (options.struct_size > sizeof options)
        options.struct_size = 4096;
    if (options.struct_size == 4096)
        options.struct_size = 12;
    options.medium = (uint32_t)usual_or_wild(1 + below(9));
    options.estimator = (uint32_t)usual_or_wild(1 + below(4));
    options.solver = (uint32_t)usual_or_wild(below(2));
    options.edge_stop = (uint32_t)usual_or_wild(1 + below(2));
    options.form = (uint32_t)usual_or_wild(below(3));
    options.directions = (uint32_t)usual_or_wild(below(3));
    options.polarity = (uint32_t)usual_or_wild(below(4));
    options.threads = 1;
    options.iterations = below(4) ? below(100) : 0;
    if (below(4) == 0)
        options.power = number();
    if (below(4) == 0)
        options.floor = number();
    if (below(4) == 0)
        options.contrast = number();
    if (below(4) == 0)
        options.smoothing = fmin(number(), 40);
    if (below(4) == 0)
        options.range_low = number();
    if (below(4) == 0)
        options.reference = number();
    if (below(8) == 0)
        options.step = number();
    if (below(4) == 0)
        options.farthest = number();
    if (below(4) == 0)
        options.anisotropy = number();
    if (below(4) == 0)
        options.elongation = number();
    if (below(4) == 0)
        options.normalize = number();
    if (below(4) == 0)
        options.margin = number();
    if (below(4) == 0) {
        options.scales = scales;
        options.scale_count = usual_or_wild(below(4));
        if (options.scale_count > 3 && options.scale_count <= 64)
            options.scales = NULL;
    }
    return options;
}

/* Every answer is a status with a name, and a message if it is a failure. */
static void answer(hp_status status)
{
    if (status < HP_OK || status > HP_NO_ANSWER || status == HP_PANIC ||
        (status != HP_OK && strlen(hp_last_error_message()) < 8)) {
        printf("%s: %s\n", hp_status_name(status), hp_last_error_message());
        abort();
    }
}

static void use_solver(const hp_solver *solver, const double *points, const hp_options *options,
                       const hp_buffer *target, const hp_buffer *other)
{
    const double *end = points + 3;
    double distance;
    hp_paths *paths;
    hp_array row;
    hp_buffer labels = *other;
    hp_array_init(&row, sizeof row);
    row.type = (uint32_t)usual_or_wild(HP_F64);
    row.count = usual_or_wild(1);
    row.data = &distance;
    if (labels.type == HP_U8)
        labels.type = HP_I32;
    answer(hp_solver_distances(solver, points, 1, options, target, 0));
    answer(hp_solver_nearest(solver, points, 1, options, target, &labels, NULL, 0));
    answer(hp_solver_nearest(solver, points, 1, options, NULL, NULL, target, 0));
    answer(hp_solver_matrix(solver, points, 1, end, 1, options, &row, 0));
    answer(hp_solver_bridge(solver, points, 1, end, 1, options, target));
    answer(hp_solver_paths_create(solver, points, 1, end, 1, options, &paths));
    hp_paths_free(paths);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint64_t side[3] = {0, 0, 0}, count;
    double points[6], scales[3], found[HP_MOST_TUBE_SCALES];
    hp_buffer image, mask, first, second;
    hp_options options;
    hp_graph *graph;
    hp_paths *paths;
    hp_solver *solver;
    int i;
    bytes = data, bytes_left = size;
    side[0] = 1 + below(12), side[1] = 1 + below(12);
    if (below(4) == 0)
        side[2] = 1 + below(5);
    for (i = 0; i < 6; i++)
        points[i] = below(8) ? (double)below(9) : number();
    for (i = 0; i < 3; i++)
        scales[i] = below(8) ? 1 + (double)below(3) : fmin(number(), 20);
    image = any_buffer(0, side, 1 + (uint32_t)below(8));
    mask = any_buffer(1, side, HP_U8);
    first = any_buffer(2, side, HP_F64);
    second = any_buffer(3, side, HP_U8);
    options = any_options(scales);
    {
        const hp_buffer *walls = below(2) ? &mask : NULL;
        const hp_options *how = below(8) ? &options : NULL;
        uint64_t sources = below(3);
        switch (below(7)) {
        case 0: answer(hp_distance(&image, walls, points, sources, how, &first)); break;
        case 1: answer(hp_medium(&image, walls, points, sources, how, &first)); break;
        case 2:
            answer(hp_paths_create(&image, walls, points, sources, points + 3, 1, how, &paths));
            hp_paths_free(paths);
            break;
        case 3:
            answer(hp_votes_create(&image, walls, points, sources, how, NULL, &first, &second,
                                   &graph));
            hp_graph_free(graph);
            break;
        case 4: answer(hp_tube_scales(&image, walls, how, found, &count)); break;
        case 5:
            answer(hp_key_points_create(&image, walls, points, sources, how, NULL, &graph));
            hp_graph_free(graph);
            break;
        default:
            answer(hp_solver_create(&image, walls, how, &solver));
            if (solver)
                use_solver(solver, points, how, &first, &second);
            hp_solver_free(solver);
        }
    }
    return 0;
}

#ifndef FUZZER
/* Vigna's splitmix64: the same numbers on every machine. */
static uint64_t random_state = 1;

static uint64_t random_number(void)
{
    uint64_t z = random_state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

int main(int argc, char **argv)
{
    long calls = argc > 1 ? atol(argv[1]) : 2000, call;
    uint64_t input[400];
    size_t i;
    for (call = 0; call < calls; call++) {
        for (i = 0; i < sizeof input / sizeof *input; i++)
            input[i] = random_number();
        for (i = 0; i < ARENA; i++)
            arena[0][i] = (unsigned char)random_number();
        LLVMFuzzerTestOneInput((const uint8_t *)input, sizeof input);
    }
    return 0;
}
#endif
