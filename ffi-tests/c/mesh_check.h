/* What the test programs for meshes share: a sphere, and short ways to describe lists. */
#ifndef MESH_CHECK_H
#define MESH_CHECK_H

#include "check.h"

#include <stdlib.h>

/* An octahedron divided into four LEVELS times: 4^(LEVELS + 1) + 2 vertices. */
enum { LEVELS = 3, VERTICES = 258, FACES = 512 };

static double points[VERTICES][3];
static uint32_t faces[FACES][3];
static uint32_t vertex_count, face_count;

static inline hp_array array_of(const void *data, uint32_t type, uint64_t count)
{
    hp_array array;
    EXPECT(HP_OK, "", hp_array_init(&array, sizeof array));
    array.data = (void *)data;
    array.type = type;
    array.count = count;
    return array;
}

static inline hp_mesh_options mesh_defaults(void)
{
    hp_mesh_options options;
    EXPECT(HP_OK, "", hp_mesh_options_init(&options, sizeof options));
    options.threads = 1;
    return options;
}

static inline hp_surface_points surface_points(void)
{
    hp_surface_points places;
    EXPECT(HP_OK, "", hp_surface_points_init(&places, sizeof places));
    return places;
}

static inline hp_surface_points at_vertices(const hp_array *numbers)
{
    hp_surface_points places = surface_points();
    places.vertices = numbers;
    return places;
}

/* The vertex on the sphere between two others, made once. */
static inline uint32_t middle(uint32_t a, uint32_t b, uint32_t first)
{
    double point[3], length = 0;
    uint32_t i;
    int axis;
    for (axis = 0; axis < 3; axis++) {
        point[axis] = points[a][axis] + points[b][axis];
        length += point[axis] * point[axis];
    }
    for (axis = 0; axis < 3; axis++)
        point[axis] /= sqrt(length);
    for (i = first; i < vertex_count; i++)
        if (fabs(points[i][0] - point[0]) + fabs(points[i][1] - point[1])
                + fabs(points[i][2] - point[2]) < 1e-9)
            return i;
    memcpy(points[vertex_count], point, sizeof point);
    return vertex_count++;
}

static inline void make_sphere(void)
{
    static const uint32_t octants[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    uint32_t i, level, first, count;
    for (i = 0; i < 6; i++)
        points[i][i / 2] = i % 2 ? -1 : 1;
    memcpy(faces, octants, sizeof octants);
    vertex_count = 6;
    face_count = 8;
    for (level = 0; level < LEVELS; level++) {
        first = vertex_count;
        count = face_count;
        for (i = 0; i < count; i++) {
            const uint32_t a = faces[i][0], b = faces[i][1], c = faces[i][2];
            const uint32_t ab = middle(a, b, first), bc = middle(b, c, first), ca = middle(c, a, first);
            const uint32_t corners[3][3] = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}};
            faces[i][0] = ab, faces[i][1] = bc, faces[i][2] = ca;
            memcpy(faces[face_count], corners, sizeof corners);
            face_count += 3;
        }
    }
    CHECK(vertex_count == VERTICES && face_count == FACES);
}

static inline hp_mesh *mesh_of(const hp_array *xyz, const hp_array *corners, const hp_array *starts,
                               const hp_mesh_options *options)
{
    hp_mesh *mesh = NULL;
    EXPECT(HP_OK, "", hp_mesh_create(xyz, corners, starts, options, &mesh));
    CHECK(mesh != NULL);
    return mesh;
}

static inline hp_mesh *sphere(void)
{
    const hp_array xyz = array_of(points, HP_F64, VERTICES), corners = array_of(faces, HP_U32, FACES);
    return mesh_of(&xyz, &corners, NULL, NULL);
}

static inline hp_mesh_solver *solver_of(const hp_mesh *mesh, const hp_mesh_options *options)
{
    hp_mesh_solver *solver = NULL;
    EXPECT(HP_OK, "", hp_mesh_solver_create(mesh, options, &solver));
    CHECK(solver != NULL);
    return solver;
}

/* The distances of `count` vertices from one of them. */
static inline void distances_from(const hp_mesh_solver *solver, uint32_t vertex, double *result,
                                  uint64_t count)
{
    const hp_array number = array_of(&vertex, HP_U32, 1), target = array_of(result, HP_F64, count);
    const hp_surface_points source = at_vertices(&number);
    EXPECT(HP_OK, "",
           hp_mesh_solver_distances(solver, &source, NULL, &target, 0, NULL, 0));
}

/* The angle between two vertices, which is their distance on the sphere. */
static inline double angle(uint32_t a, uint32_t b)
{
    const double *p = points[a], *q = points[b];
    const double x = p[1] * q[2] - p[2] * q[1], y = p[2] * q[0] - p[0] * q[2];
    const double z = p[0] * q[1] - p[1] * q[0];
    return atan2(sqrt(x * x + y * y + z * z), p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
}

#endif
