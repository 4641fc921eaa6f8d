/* The same picture in many layouts of memory must give the same distances, bit for bit. */
#include "check.h"

static const double source[2] = {3, 4};
static double reference[PIXELS];

/* The same picture as whole numbers up to 250. */
static int level(int x, int y)
{
    return (int)(grey(x, y) * 250.0);
}

/* The distances that belong to an image, written packed. */
static void distances_of(int line, const hp_buffer *image, const hp_options *options, double *result)
{
    hp_buffer target = buffer_of(result, HP_F64);
    expect(line, "distance", hp_distance(image, NULL, source, 1, options, &target), HP_OK, "");
}

static void same(int line, const char *what, const hp_buffer *image)
{
    double result[PIXELS];
    hp_options options = defaults();
    /* What the range of the bytes is. */
    options.range_low = 0;
    options.range_high = 255;
    memset(result, 0xff, sizeof result);
    distances_of(line, image, &options, result);
    if (memcmp(result, reference, sizeof result) != 0)
        complain(line, what, "differs from packed bytes");
}

#define SAME(image) same(__LINE__, #image, &(image))

/* Packed pixels of one type; then 1 byte further on, so that they are not aligned. */
#define SAME_AS(ctype, hptype)                                                                     \
    do {                                                                                           \
        ctype packed[PIXELS];                                                                      \
        char shifted[sizeof packed + 1];                                                           \
        hp_buffer as_##ctype = buffer_of(packed, (hptype));                                        \
        hp_buffer misaligned_##ctype = buffer_of(shifted + 1, (hptype));                           \
        int i;                                                                                     \
        for (i = 0; i < PIXELS; i++)                                                               \
            packed[i] = (ctype)level(i % WIDTH, i / WIDTH);                                        \
        memcpy(shifted + 1, packed, sizeof packed);                                                \
        SAME(as_##ctype);                                                                          \
        SAME(misaligned_##ctype);                                                                  \
    } while (0)

static void all_types(void)
{
    SAME_AS(uint8_t, HP_U8);
    SAME_AS(uint16_t, HP_U16);
    SAME_AS(int16_t, HP_I16);
    SAME_AS(uint32_t, HP_U32);
    SAME_AS(int32_t, HP_I32);
    SAME_AS(float, HP_F32);
    SAME_AS(double, HP_F64);
}

/* int8_t has no room for 0 to 250: half of it, with half of the range. */
static void signed_bytes(void)
{
    int8_t bytes[PIXELS];
    double halves[PIXELS], of_bytes[PIXELS], of_halves[PIXELS];
    hp_buffer image = buffer_of(bytes, HP_I8), other = buffer_of(halves, HP_F64);
    int i;
    for (i = 0; i < PIXELS; i++)
        halves[i] = bytes[i] = (int8_t)(level(i % WIDTH, i / WIDTH) - 125);
    distances_of(__LINE__, &image, NULL, of_bytes);
    distances_of(__LINE__, &other, NULL, of_halves);
    CHECK(memcmp(of_bytes, of_halves, sizeof of_bytes) == 0);
}

static void inputs(void)
{
    static uint8_t part[HEIGHT + 5][WIDTH + 9], colour[HEIGHT][WIDTH][3];
    static uint8_t upside_down[HEIGHT][WIDTH], turned[HEIGHT][WIDTH], by_columns[WIDTH][HEIGHT];
    hp_buffer sub_image = buffer_of(&part[2][7], HP_U8);
    hp_buffer channel = buffer_of(&colour[0][0][1], HP_U8);
    hp_buffer flipped = buffer_of(upside_down[HEIGHT - 1], HP_U8);
    hp_buffer rotated = buffer_of(&turned[HEIGHT - 1][WIDTH - 1], HP_U8);
    hp_buffer transposed = buffer_of(by_columns, HP_U8);
    int x, y;
    for (y = 0; y < HEIGHT; y++) {
        for (x = 0; x < WIDTH; x++) {
            uint8_t value = (uint8_t)level(x, y);
            part[y + 2][x + 7] = colour[y][x][1] = value;
            upside_down[HEIGHT - 1 - y][x] = by_columns[x][y] = value;
            turned[HEIGHT - 1 - y][WIDTH - 1 - x] = value;
        }
    }
    sub_image.byte_stride[1] = WIDTH + 9;
    channel.byte_stride[0] = 3;
    flipped.byte_stride[1] = -WIDTH;
    rotated.byte_stride[0] = -1;
    rotated.byte_stride[1] = -WIDTH;
    transposed.byte_stride[0] = HEIGHT;
    transposed.byte_stride[1] = 1;
    SAME(sub_image);
    SAME(channel);
    SAME(flipped);
    SAME(rotated);
    SAME(transposed);
}

static void outputs(void)
{
    static double wide[HEIGHT][2 * WIDTH + 3];
    static char bytes[PIXELS * sizeof(float) + 1];
    static double in_place[PIXELS];
    hp_buffer every_other = buffer_of(wide[HEIGHT - 1], HP_F64);
    hp_buffer floats = buffer_of(bytes + 1, HP_F32);
    hp_buffer both = buffer_of(in_place, HP_F64);
    hp_options options = defaults();
    int x, y;
    options.range_low = 0;
    options.range_high = 255;
    for (y = 0; y < HEIGHT; y++)
        for (x = 0; x < WIDTH; x++)
            in_place[y * WIDTH + x] = level(x, y);
    every_other.byte_stride[0] = 2 * sizeof(double);
    every_other.byte_stride[1] = -(int64_t)sizeof wide[0];
    EXPECT(HP_OK, "", hp_distance(&both, NULL, source, 1, &options, &every_other));
    EXPECT(HP_OK, "", hp_distance(&both, NULL, source, 1, &options, &floats));
    EXPECT(HP_OK, "", hp_distance(&both, NULL, source, 1, &options, &both));
    CHECK(memcmp(in_place, reference, sizeof in_place) == 0);
    for (y = 0; y < HEIGHT; y++) {
        for (x = 0; x < WIDTH; x++) {
            float value;
            memcpy(&value, bytes + 1 + (y * WIDTH + x) * sizeof value, sizeof value);
            CHECK(value == (float)reference[y * WIDTH + x]);
            CHECK(wide[HEIGHT - 1 - y][2 * x] == reference[y * WIDTH + x]);
            CHECK(wide[HEIGHT - 1 - y][2 * x + 1] == 0);
        }
    }
}

/* Natural ranges: the type's for bytes, the picture's for doubles. */
static void ranges(void)
{
    static uint8_t bytes[PIXELS];
    static double doubles[PIXELS], of_bytes[PIXELS], of_doubles[PIXELS];
    hp_buffer image = buffer_of(bytes, HP_U8), other = buffer_of(doubles, HP_F64);
    int i;
    for (i = 0; i < PIXELS; i++)
        doubles[i] = bytes[i] = (uint8_t)level(i % WIDTH, i / WIDTH);
    distances_of(__LINE__, &image, NULL, of_bytes);
    CHECK(memcmp(of_bytes, reference, sizeof reference) == 0);
    distances_of(__LINE__, &other, NULL, of_doubles);
    CHECK(memcmp(of_doubles, reference, sizeof reference) != 0);
    /* A picture of one value only is a uniform one. */
    memset(bytes, 77, sizeof bytes);
    distances_of(__LINE__, &image, NULL, of_bytes);
    for (i = 0; i < PIXELS; i++)
        doubles[i] = -77;
    distances_of(__LINE__, &other, NULL, of_doubles);
    CHECK(memcmp(of_bytes, of_doubles, sizeof of_bytes) == 0);
}

/* One row, one column and one pixel are images too, whatever their strides. */
static void thin_images(void)
{
    double pixels[3] = {0.1, 0.2, 0.3}, result[3];
    const double first[2] = {0, 0};
    hp_buffer image = buffer_of(pixels, HP_F64), target = buffer_of(result, HP_F64);
    hp_options options = defaults();
    options.medium = HP_MEDIUM_UNIFORM;
    image.size[0] = target.size[0] = 3;
    image.size[1] = target.size[1] = 1;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, first, 1, &options, &target));
    CHECK(result[0] == 0 && result[2] > result[1] && result[1] > 0);
    image.size[0] = target.size[0] = 1;
    image.byte_stride[0] = target.byte_stride[0] = 1;
    EXPECT(HP_OK, "", hp_distance(&image, NULL, first, 1, NULL, &target));
    CHECK(result[0] == 0);
}

int main(void)
{
    uint8_t bytes[PIXELS];
    hp_buffer image = buffer_of(bytes, HP_U8);
    hp_options options = defaults();
    int i;
    for (i = 0; i < PIXELS; i++)
        bytes[i] = (uint8_t)level(i % WIDTH, i / WIDTH);
    distances_of(__LINE__, &image, &options, reference);
    CHECK(reference[4 * WIDTH + 3] == 0 && reference[PIXELS - 1] > 10);
    all_types();
    signed_bytes();
    inputs();
    outputs();
    ranges();
    thin_images();
    return failures != 0;
}
