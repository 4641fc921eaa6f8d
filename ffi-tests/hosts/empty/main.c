/* The shortest program: the distance along a row of five pixels.
 *
 *     cc main.c $(pkg-config --cflags --libs heatpath)
 */
#include <heatpath.h>

#include <stdio.h>

int main(void)
{
    double row[5] = {0}, source[2] = {0, 0};
    hp_options options;
    hp_buffer pixels;
    hp_options_init(&options, sizeof options);
    options.medium = HP_MEDIUM_UNIFORM;
    options.estimator = HP_EIKONAL;
    hp_buffer_init(&pixels, sizeof pixels);
    pixels.type = HP_F64;
    pixels.data = row;
    pixels.size[0] = 5;
    pixels.size[1] = 1;
    if (hp_distance(&pixels, NULL, source, 1, &options, &pixels) != HP_OK) {
        fprintf(stderr, "%s\n", hp_last_error_message());
        return 1;
    }
    printf("heatpath %s: %g\n", hp_version_string(), row[4]);
    return 0;
}
