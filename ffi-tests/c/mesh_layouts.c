/* The same mesh and results in other layouts of memory: no bit changes. */
#include "mesh_check.h"

/* A vertex and a face as programs have them. */
struct vertex {
    unsigned char colour[3];
    float position[3];
};

struct face {
    int64_t corners[3];
    int16_t material;
};

static struct vertex coloured[VERTICES];
static struct face painted[FACES];
static double expected[VERTICES], result[VERTICES];

/* Floats with gaps, int64_t with gaps, both backwards. */
static void inputs(void)
{
    hp_array xyz = array_of(points, HP_F64, VERTICES), corners = array_of(faces, HP_U32, FACES);
    hp_mesh *mesh = mesh_of(&xyz, &corners, NULL, NULL);
    hp_mesh_solver *solver = solver_of(mesh, NULL);
    uint32_t i;
    int k;
    for (i = 0; i < VERTICES; i++)
        for (k = 0; k < 3; k++)
            coloured[i].position[k] = (float)points[VERTICES - 1 - i][k];
    for (i = 0; i < FACES; i++)
        for (k = 0; k < 3; k++)
            painted[i].corners[k] = faces[FACES - 1 - i][k];
    distances_from(solver, 5, expected, VERTICES);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);

    xyz = array_of(coloured[VERTICES - 1].position, HP_F32, VERTICES);
    xyz.byte_stride = -(int64_t)sizeof coloured[0];
    corners = array_of(painted[FACES - 1].corners, HP_I64, FACES);
    corners.byte_stride = -(int64_t)sizeof painted[0];
    mesh = mesh_of(&xyz, &corners, NULL, NULL);
    solver = solver_of(mesh, NULL);
    distances_from(solver, 5, result, VERTICES);
    CHECK(memcmp(result, expected, sizeof result) == 0);
    CHECK(expected[5] == 0 && expected[0] > 1);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

/* Maps, labels and matrices with gaps, as columns and in other types; with any threads. */
static void outputs(void)
{
    enum { SETS = 3, GAP = 5 };
    static double maps[SETS][VERTICES], matrix[VERTICES][VERTICES], columns[VERTICES][VERTICES];
    static float wide[VERTICES][SETS + GAP];
    static int64_t labels[SETS][VERTICES + GAP];
    static uint32_t small[SETS][VERTICES];
    const uint32_t numbers[4] = {17, 3, 200, 90}, starts[SETS + 1] = {0, 1, 3, 4};
    const hp_array sources = array_of(numbers, HP_U32, 4), sets = array_of(starts, HP_U32, SETS + 1);
    const hp_array packed = array_of(maps, HP_F64, VERTICES), all = array_of(matrix, HP_F64, VERTICES);
    const hp_array names = array_of(labels, HP_I64, VERTICES), bits = array_of(small, HP_U32, VERTICES);
    hp_array apart = array_of(wide, HP_F32, VERTICES), turned = array_of(columns, HP_F64, VERTICES);
    hp_surface_points places = at_vertices(&sources);
    hp_mesh_options options = mesh_defaults();
    hp_mesh *mesh = sphere();
    hp_mesh_solver *solver;
    uint32_t i, k;
    options.method = HP_MESH_HEAT;
    solver = solver_of(mesh, &options);
    places.sets = &sets;
    apart.byte_stride = sizeof wide[0];
    turned.byte_stride = sizeof columns[0];
    EXPECT(HP_OK, "", hp_mesh_solver_matrix(solver, NULL, &all, 0));
    EXPECT(HP_OK, "", hp_mesh_solver_matrix(solver, NULL, &turned, sizeof columns[0][0]));
    for (options.threads = 1; options.threads <= 3; options.threads++) {
        memset(maps, 0, sizeof maps);
        EXPECT(HP_OK, "", hp_mesh_solver_distances(solver, &places, &options, &packed, 0, &names,
                                                   sizeof labels[0]));
        EXPECT(HP_OK, "", hp_mesh_solver_distances(solver, &places, &options, &apart,
                                                   sizeof wide[0][0], &bits, 0));
        for (i = 0; i < VERTICES; i++) {
            const double *second[2] = {matrix[numbers[1]], matrix[numbers[2]]};
            const int64_t nearest = second[0][i] <= second[1][i] ? 1 : 2;
            CHECK(maps[0][i] == matrix[17][i] && maps[2][i] == matrix[90][i]);
            CHECK(maps[1][i] == second[nearest - 1][i]);
            CHECK(labels[0][i] == 0 && labels[1][i] == nearest && labels[2][i] == 3);
            for (k = 0; k < SETS; k++)
                CHECK(wide[i][k] == (float)maps[k][i] && small[k][i] == labels[k][i]);
            for (k = SETS; k < SETS + GAP; k++)
                CHECK(wide[i][k] == 0 && labels[1][VERTICES + k - SETS] == 0);
        }
    }
    for (i = 0; i < VERTICES; i++)
        for (k = 0; k < VERTICES; k++)
            CHECK(columns[k][i] == matrix[i][k]);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

/* Triangles that share no vertex, as in STL: every corner has the distance of its vertex. */
static void welding(void)
{
    static double soup[FACES][3][3], distances[FACES][3];
    static uint16_t corners[FACES][3];
    static int64_t left[FACES][3];
    const hp_array xyz = array_of(soup, HP_F64, 3 * FACES), numbers = array_of(corners, HP_U16, FACES);
    const hp_array target = array_of(left, HP_I64, FACES);
    hp_mesh_options options = mesh_defaults();
    hp_mesh_report report;
    hp_mesh *mesh;
    hp_mesh_solver *solver;
    uint32_t i, k, first = 0;
    for (i = 0; i < FACES; i++)
        for (k = 0; k < 3; k++) {
            memcpy(soup[i][k], points[faces[i][k]], sizeof soup[i][k]);
            corners[i][k] = (uint16_t)(3 * i + k);
        }
    report.struct_size = sizeof report;
    mesh = mesh_of(&xyz, &numbers, NULL, NULL);
    EXPECT(HP_OK, "", hp_mesh_describe(mesh, &report));
    CHECK(report.components == FACES && report.shared_positions == 3 * FACES - VERTICES);
    hp_mesh_free(mesh);

    options.weld = 0;
    options.method = HP_MESH_EXACT;
    mesh = mesh_of(&xyz, &numbers, NULL, &options);
    EXPECT(HP_OK, "", hp_mesh_describe(mesh, &report));
    CHECK(report.struct_size == sizeof report && report.vertices == 3 * FACES);
    CHECK(report.faces == FACES && report.welded == 3 * FACES - VERTICES);
    CHECK(report.components == 1 && report.euler_characteristic == 2 && report.border_edges == 0);
    EXPECT(HP_OK, "", hp_mesh_faces(mesh, &target));
    for (i = 0; i < FACES; i++)
        for (k = 0; k < 3; k++) {
            const int64_t vertex = left[i][k];
            CHECK(vertex <= (int64_t)(3 * i + k));
            CHECK(memcmp(soup[vertex / 3][vertex % 3], soup[i][k], sizeof soup[i][k]) == 0);
        }
    solver = solver_of(mesh, &options);
    /* The last corner at vertex 5. */
    for (i = 0; i < 3 * FACES; i++)
        first = faces[i / 3][i % 3] == 5 ? i : first;
    distances_from(solver, first, distances[0], 3 * FACES);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
    mesh = sphere();
    solver = solver_of(mesh, &options);
    distances_from(solver, 5, expected, VERTICES);
    for (i = 0; i < FACES; i++)
        for (k = 0; k < 3; k++)
            CHECK(fabs(distances[i][k] - expected[faces[i][k]]) < 1e-12);
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

/* A cube of squares, as a vtkCellArray has them, with a vertex that no face uses. */
static void polygons(void)
{
    static const float cube[9][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1},
                                     {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {5, 5, 5}};
    static const int64_t corners[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                        2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    static const int64_t starts[7] = {0, 4, 8, 12, 16, 20, 24};
    const hp_array xyz = array_of(cube, HP_F32, 9), numbers = array_of(corners, HP_I64, 24);
    const hp_array offsets = array_of(starts, HP_I64, 7);
    double distances[9], matrix[9][9];
    int32_t labels[9];
    const uint32_t vertex = 0;
    const hp_array source = array_of(&vertex, HP_U32, 1), target = array_of(distances, HP_F64, 9);
    const hp_array names = array_of(labels, HP_I32, 9), all = array_of(matrix, HP_F64, 9);
    const hp_surface_points places = at_vertices(&source);
    hp_mesh_options options = mesh_defaults();
    hp_mesh_report report;
    hp_mesh *mesh = mesh_of(&xyz, &numbers, &offsets, NULL);
    hp_mesh_solver *solver;
    int i;
    report.struct_size = sizeof report;
    EXPECT(HP_OK, "", hp_mesh_describe(mesh, &report));
    CHECK(report.polygons == 6 && report.faces == 12 && report.unreferenced == 1);
    CHECK(report.inconsistent_edges == 0 && report.border_edges == 0 && report.flat == 0);
    options.method = HP_MESH_EXACT;
    solver = solver_of(mesh, &options);
    EXPECT(HP_OK, "", hp_mesh_solver_distances(solver, &places, NULL, &target, 0, &names, 0));
    CHECK(fabs(distances[7] - sqrt(5.0)) < 1e-12 && fabs(distances[3] - sqrt(2.0)) < 1e-12);
    CHECK(isinf(distances[8]) && labels[8] == -1 && labels[7] == 0);
    EXPECT(HP_OK, "", hp_mesh_solver_matrix(solver, NULL, &all, 0));
    for (i = 0; i < 9; i++) {
        CHECK(matrix[0][i] == distances[i] && isinf(matrix[8][i]));
        CHECK(matrix[i][i] == 0 || i == 8);
    }
    hp_mesh_solver_free(solver);

    /* Nothing beyond a distance. */
    options.farthest = 1.2;
    solver = solver_of(mesh, &options);
    EXPECT(HP_OK, "", hp_mesh_solver_distances(solver, &places, NULL, &target, 0, &names, 0));
    for (i = 0; i < 8; i++)
        CHECK(i == 0 || i == 1 || i == 2 || i == 4 ? labels[i] == 0 : isinf(distances[i]));
    hp_mesh_solver_free(solver);
    hp_mesh_free(mesh);
}

int main(void)
{
    uint32_t i;
    int k;
    make_sphere();
    /* Numbers that float has too. */
    for (i = 0; i < VERTICES; i++)
        for (k = 0; k < 3; k++)
            points[i][k] = (float)points[i][k];
    inputs();
    outputs();
    welding();
    polygons();
    return failures != 0;
}
