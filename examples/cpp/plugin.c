/* heatpath found at run time: a host that works without it, and better with it.
 *
 *     plugin LIBRARY        such as libheatpath.so.0
 *
 *     cc -std=c99 plugin.c -ldl
 */
#include "heatpath.h"

#include <dlfcn.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

typedef const hp_api *(*get_api)(uint32_t abi_version);

static const hp_api *load(const char *library)
{
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    const hp_api *api = NULL;
    get_api get;
    void *symbol;
    if (!handle) {
        fprintf(stderr, "plugin: %s\n", dlerror());
        return NULL;
    }
    symbol = dlsym(handle, "hp_get_api");
    if (symbol) {
        memcpy(&get, &symbol, sizeof get); /* C has no cast from an object to a function */
        api = get(HP_ABI_VERSION);
    }
    /* What this program calls must be there; a library may be older than the header. */
    if (!api || api->struct_size < offsetof(hp_api, distance) + sizeof api->distance) {
        fprintf(stderr, "plugin: %s is no heatpath that fits\n", library);
        return NULL;
    }
    return api;
}

int main(int argc, char **argv)
{
    static unsigned char pixels[32 * 24];
    static double distances[32 * 24];
    const double source[2] = {4, 5};
    const hp_api *api;
    hp_buffer image, result;
    hp_options options;
    if (argc != 2) {
        fprintf(stderr, "usage: plugin LIBRARY\n");
        return 2;
    }
    api = load(argv[1]);
    if (!api)
        return 1;
    printf("heatpath %s\n", api->version_string());
    api->buffer_init(&image, sizeof image);
    image.data = pixels, image.type = HP_U8;
    image.size[0] = 32, image.size[1] = 24;
    result = image, result.data = distances, result.type = HP_F64;
    api->options_init(&options, sizeof options);
    options.medium = HP_MEDIUM_UNIFORM;
    options.estimator = HP_EIKONAL;
    if (api->distance(&image, NULL, source, 1, &options, &result) != HP_OK) {
        fprintf(stderr, "plugin: %s\n", api->last_error_message());
        return 1;
    }
    printf("%.6f\n", distances[5 * 32 + 24]); /* 20 to the right */
    return 0;
}
