/* A host that loads heatpath as a plugin, uses it on a picture and on a mesh, and lets it go; twice.
 *
 *     loader LIBRARY        such as /usr/local/lib/libheatpath.so.0
 *
 * One symbol is asked for by name; all functions are in the table that it returns.
 */
#include <heatpath.h>

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef const hp_api *(*get_api)(uint32_t abi_version);

static void expect(int fine, const char *what)
{
    if (!fine) {
        fprintf(stderr, "loader: %s\n", what);
        exit(EXIT_FAILURE);
    }
}

static get_api find(void *library)
{
    void *symbol = dlsym(library, "hp_get_api");
    get_api get;
    expect(symbol != NULL, "the library has no table of functions");
    memcpy(&get, &symbol, sizeof get); /* C has no cast from an object to a function */
    return get;
}

static int stop(double finished, void *user)
{
    (void)finished;
    (void)user;
    return 1;
}

static void on_a_picture(const hp_api *api)
{
    static double pixels[20 * 12];
    const double source[2] = {3, 5}, end[2] = {18, 5};
    hp_path_info info;
    hp_options options;
    hp_buffer picture;
    hp_paths *paths;
    expect(api->buffer_init(&picture, sizeof picture) == HP_OK, "buffer_init");
    expect(api->options_init(&options, sizeof options) == HP_OK, "options_init");
    picture.data = pixels;
    picture.type = HP_F64;
    picture.size[0] = 20;
    picture.size[1] = 12;
    options.medium = HP_MEDIUM_UNIFORM;
    options.estimator = HP_EIKONAL;
    expect(api->distance(&picture, NULL, source, 1, &options, &picture) == HP_OK, "distance");
    expect(fabs(pixels[5 * 20 + 18] - 15) < 1e-9, "the distance of 15 pixels");

    expect(api->paths_create(&picture, NULL, source, 1, end, 1, &options, &paths) == HP_OK, "path");
    info.struct_size = sizeof info;
    expect(api->paths_info(paths, 0, &info) == HP_OK, "paths_info");
    expect(info.ending == HP_ENDED_SOURCE && fabs(info.length - 15) < 1e-6, "a straight path");
    api->paths_free(paths);

    options.estimator = HP_NORMALIZED;
    options.progress = stop;
    expect(api->distance(&picture, NULL, source, 1, &options, &picture) == HP_CANCELLED, "cancel");
    expect(strstr(api->last_error_message(), "cancel") != NULL, "a message about it");
}

/* Two triangles make a square; the way from corner to corner is its diagonal. */
static void on_a_mesh(const hp_api *api)
{
    float corners[4][3] = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}};
    uint32_t triangles[2][3] = {{0, 1, 3}, {1, 2, 3}}, first = 0;
    double distances[4];
    hp_array points, faces, vertices, result;
    hp_surface_points source;
    hp_mesh_solver *solver;
    hp_mesh *mesh;
    expect(api->array_init(&points, sizeof points) == HP_OK, "array_init");
    faces = vertices = result = points;
    points.type = HP_F32, points.data = corners, points.count = 4;
    faces.type = HP_U32, faces.data = triangles, faces.count = 2;
    vertices.type = HP_U32, vertices.data = &first, vertices.count = 1;
    result.type = HP_F64, result.data = distances, result.count = 4;
    expect(api->mesh_create(&points, &faces, NULL, NULL, &mesh) == HP_OK, "mesh_create");
    expect(api->mesh_solver_create(mesh, NULL, &solver) == HP_OK, "mesh_solver_create");
    api->mesh_free(mesh);
    expect(api->surface_points_init(&source, sizeof source) == HP_OK, "surface_points_init");
    source.vertices = &vertices;
    expect(api->mesh_solver_distances(solver, &source, NULL, &result, 0, NULL, 0) == HP_OK,
           "mesh_solver_distances");
    api->mesh_solver_free(solver);
    expect(fabs(distances[2] - sqrt(18)) < 1e-9, "the diagonal of a square");
}

int main(int count, char **arguments)
{
    int round;
    expect(count == 2, "usage: loader LIBRARY");
    for (round = 0; round < 2; round++) {
        void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
        const hp_api *api;
        expect(library != NULL, library ? "" : dlerror());
        expect(find(library)(HP_ABI_VERSION + 1) == NULL, "a table for a version to come");
        api = find(library)(HP_ABI_VERSION);
        expect(api != NULL, "the library does not fit to the header");
        expect(api->struct_size == sizeof *api, "the table is longer or shorter than the header's");
        on_a_picture(api);
        on_a_mesh(api);
        dlclose(library);
    }
    return EXIT_SUCCESS;
}
