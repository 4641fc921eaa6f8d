/* Places on faces go out and come back, and loops become as short as they get. */
#include "mesh_check.h"

enum { AROUND = 48, ALONG = 24, SPOTS = 3, MOST = 1000 };

static const double pi = 3.141592653589793;
static const double above[SPOTS][3] = {{2, 0.1, 0}, {0.3, -0.4, 0.2}, {-1, -1, -1}};
static uint32_t on[SPOTS];
static double weights[SPOTS][3], positions[SPOTS][3];

static hp_surface_points on_faces(const hp_array *numbers, const hp_array *shares)
{
    hp_surface_points places = surface_points();
    places.faces = numbers;
    places.weights = shares;
    return places;
}

/* The place of a point is the nearest to it, and the same in other words. */
static void located(void)
{
    const hp_array numbers = array_of(on, HP_U32, SPOTS), shares = array_of(weights, HP_F64, SPOTS);
    const hp_array xyz = array_of(positions, HP_F64, SPOTS), given = array_of(above, HP_F64, SPOTS);
    static double again[SPOTS][3];
    const hp_array target = array_of(again, HP_F64, SPOTS);
    hp_surface_points places = surface_points();
    hp_mesh *mesh = sphere();
    int i, axis;
    places.positions = &given;
    EXPECT(HP_OK, "", hp_mesh_locate(mesh, &places, &numbers, &shares, &xyz));
    for (i = 0; i < SPOTS; i++) {
        double length = 0;
        CHECK(on[i] < FACES && fabs(weights[i][0] + weights[i][1] + weights[i][2] - 1) < 1e-12);
        for (axis = 0; axis < 3; axis++) {
            const uint32_t *corners = faces[on[i]];
            const double at = weights[i][0] * points[corners[0]][axis] +
                              weights[i][1] * points[corners[1]][axis] +
                              weights[i][2] * points[corners[2]][axis];
            CHECK(fabs(at - positions[i][axis]) < 1e-12);
            length += at * at;
        }
        CHECK(sqrt(length) > 0.98 && sqrt(length) < 1 + 1e-12);
    }
    places = on_faces(&numbers, &shares);
    EXPECT(HP_OK, "", hp_mesh_locate(mesh, &places, NULL, NULL, &target));
    CHECK(memcmp(again, positions, sizeof again) == 0);
    hp_mesh_free(mesh);
}

static hp_path_info info_of(const hp_paths *paths)
{
    hp_path_info info;
    info.struct_size = sizeof info;
    EXPECT(HP_OK, "", hp_paths_info(paths, 0, &info));
    return info;
}

/* The place of a path's last point is its source. */
static void places_of_paths(void)
{
    static int64_t numbers[VERTICES];
    static float shares[VERTICES][3];
    const uint32_t source = 5, end = 200;
    const hp_array from = array_of(&source, HP_U32, 1), to = array_of(&end, HP_U32, 1);
    const hp_surface_points sources = at_vertices(&from), ends = at_vertices(&to);
    hp_array face_list = array_of(numbers, HP_I64, 0), weight_list = array_of(shares, HP_F32, 0);
    hp_mesh *mesh = sphere();
    hp_mesh_solver *solver = solver_of(mesh, NULL);
    hp_paths *paths = NULL;
    int corner, is_source = 0;
    uint64_t last;
    EXPECT(HP_OK, "", hp_mesh_paths_create(solver, &sources, &ends, NULL, &paths));
    EXPECT(HP_INVALID_BUFFER, "faces: count is 0", hp_paths_places(paths, 0, &face_list, NULL));
    face_list.count = weight_list.count = info_of(paths).point_count;
    EXPECT(HP_OK, "", hp_paths_places(paths, 0, &face_list, &weight_list));
    last = info_of(paths).point_count - 1;
    for (corner = 0; corner < 3; corner++)
        is_source |= faces[numbers[last]][corner] == source && shares[last][corner] == 1;
    CHECK(is_source);
    EXPECT(HP_INVALID_ARGUMENT, "path 1 does not exist", hp_paths_places(paths, 1, NULL, NULL));
    hp_paths_free(paths);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

static void paths_on_images_have_none(void)
{
    static double data[PIXELS];
    const double ends[4] = {1, 1, 9, 9};
    const hp_buffer image = buffer_of(data, HP_F64);
    hp_options options = defaults();
    hp_paths *paths = NULL;
    options.medium = HP_MEDIUM_UNIFORM;
    EXPECT(HP_OK, "", hp_paths_create(&image, NULL, ends, 1, ends + 2, 1, &options, &paths));
    EXPECT(HP_INVALID_ARGUMENT, "lies on an image", hp_paths_places(paths, 0, NULL, NULL));
    hp_paths_free(paths);
}

/* A torus around z, of radii 2 and 0.75. */
static hp_mesh *torus(void)
{
    static double xyz[AROUND * ALONG][3];
    static uint32_t corners[2 * AROUND * ALONG][3];
    const hp_array vertices = array_of(xyz, HP_F64, AROUND * ALONG);
    const hp_array triangles = array_of(corners, HP_U32, 2 * AROUND * ALONG);
    uint32_t i, j;
    for (i = 0; i < AROUND; i++)
        for (j = 0; j < ALONG; j++) {
            const double radius = 2 + 0.75 * cos(2 * pi * j / ALONG);
            const uint32_t a = i * ALONG + j, b = i * ALONG + (j + 1) % ALONG;
            const uint32_t c = (i + 1) % AROUND * ALONG + j, d = c - j + (j + 1) % ALONG;
            const uint32_t pair[2][3] = {{a, c, b}, {b, c, d}};
            xyz[a][0] = radius * cos(2 * pi * i / AROUND);
            xyz[a][1] = radius * sin(2 * pi * i / AROUND);
            xyz[a][2] = 0.75 * sin(2 * pi * j / ALONG);
            memcpy(corners[2 * a], pair, sizeof pair);
        }
    return mesh_of(&vertices, &triangles, NULL, NULL);
}

/* The length of the loop that a curve becomes, 0 if it contracts. */
static double shortest(const hp_mesh *mesh, const hp_surface_points *curve)
{
    hp_paths *loops = NULL;
    uint64_t count = 9;
    double length = 0;
    EXPECT(HP_OK, "", hp_mesh_loop_create(mesh, curve, &loops));
    EXPECT(HP_OK, "", hp_paths_count(loops, &count));
    CHECK(count <= 1);
    if (count == 1) {
        const hp_path_info info = info_of(loops);
        CHECK(info.ending == HP_ENDED_CLOSED && info.source == -1 && isinf(info.distance));
        length = info.length;
    }
    hp_paths_free(loops);
    return length;
}

static int is_polygon(double length, int sides, double radius, double error)
{
    return fabs(length - 2 * sides * radius * sin(pi / sides)) < error;
}

/* Around the tube, around the hole, and around nothing. */
static void loops(void)
{
    const uint32_t triangle[3] = {0, ALONG, 1}, apart[3] = {0, 5, 9};
    static uint32_t around_tube[ALONG], around_hole[AROUND];
    hp_array list = array_of(around_tube, HP_U32, ALONG);
    const hp_surface_points curve = at_vertices(&list);
    hp_mesh *mesh = torus();
    hp_paths *none = NULL;
    uint32_t i;
    for (i = 0; i < ALONG; i++)
        around_tube[i] = 7 * ALONG + i;
    for (i = 0; i < AROUND; i++)
        around_hole[i] = i * ALONG + ALONG / 3;
    /* Between two of its rings the tube is a little thinner. */
    CHECK(is_polygon(shortest(mesh, &curve), ALONG, 0.75, 0.01));
    list = array_of(around_hole, HP_U32, AROUND);
    CHECK(is_polygon(shortest(mesh, &curve), AROUND, 1.25, 1e-9));
    list = array_of(triangle, HP_U32, 3);
    CHECK(shortest(mesh, &curve) == 0);
    list = array_of(apart, HP_U32, 3);
    EXPECT(HP_INVALID_POINT, "points: points 0 and 1 lie on no common face",
           hp_mesh_loop_create(mesh, &curve, &none));
    CHECK(none == NULL);
    list.count = 0;
    EXPECT(HP_INVALID_POINT, "no point", hp_mesh_loop_create(mesh, &curve, &none));
    hp_mesh_free(mesh);
}

/* Through two other points and back again: a loop around the hole, from paths. */
static void loops_of_paths(void)
{
    static uint32_t numbers[MOST];
    static double shares[MOST][3];
    const uint32_t stops[4] = {0, 16 * ALONG, 32 * ALONG, 0};
    const hp_array list = array_of(stops, HP_U32, 4);
    const hp_surface_points through = at_vertices(&list);
    hp_array face_list = array_of(numbers, HP_U32, 0), weight_list = array_of(shares, HP_F64, 0);
    const hp_surface_points curve = on_faces(&face_list, &weight_list);
    hp_mesh *mesh = torus();
    hp_mesh_solver *solver = solver_of(mesh, NULL);
    hp_paths *paths = NULL;
    EXPECT(HP_OK, "", hp_mesh_paths_through(solver, &through, NULL, &paths));
    face_list.count = weight_list.count = info_of(paths).point_count;
    CHECK(face_list.count < MOST);
    EXPECT(HP_OK, "", hp_paths_places(paths, 0, &face_list, &weight_list));
    CHECK(is_polygon(shortest(mesh, &curve), AROUND, 1.25, 1e-9));
    hp_paths_free(paths);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

static void misuse(void)
{
    const uint32_t vertex = 3;
    const hp_array numbers = array_of(on, HP_U32, SPOTS), shares = array_of(weights, HP_F64, 1);
    const hp_array one = array_of(&vertex, HP_U32, 1);
    const hp_surface_points places = at_vertices(&one);
    hp_mesh *mesh = sphere();
    EXPECT(HP_OK, "", hp_mesh_locate(mesh, &places, NULL, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "mesh is NULL", hp_mesh_locate(NULL, &places, NULL, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "points is NULL", hp_mesh_locate(mesh, NULL, NULL, NULL, NULL));
    EXPECT(HP_INVALID_BUFFER, "faces: count is 3; it must be 1",
           hp_mesh_locate(mesh, &places, &numbers, NULL, NULL));
    EXPECT(HP_INVALID_BUFFER, "faces: its type", hp_mesh_locate(mesh, &places, &shares, NULL, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "loops is NULL", hp_mesh_loop_create(mesh, &places, NULL));
    EXPECT(HP_INVALID_ARGUMENT, "paths is NULL", hp_paths_places(NULL, 0, NULL, NULL));
    hp_mesh_free(mesh);
}

int main(void)
{
    make_sphere();
    located();
    places_of_paths();
    paths_on_images_have_none();
    loops();
    loops_of_paths();
    misuse();
    return failures != 0;
}
