/* Prints the size of each struct of the header and where its fields begin. */
#include "heatpath.h"

#include <stddef.h>
#include <stdio.h>

#define SIZE(type) printf(#type " %u\n", (unsigned)sizeof(type))
#define AT(type, field) printf(#type "." #field " %u\n", (unsigned)offsetof(type, field))

int main(void)
{
    SIZE(hp_buffer);
    AT(hp_buffer, data);
    AT(hp_buffer, spacing);
    SIZE(hp_options);
    AT(hp_options, smoothing);
    AT(hp_options, estimator);
    AT(hp_options, user);
    AT(hp_options, solver);
    AT(hp_options, reference);
    AT(hp_options, memory);
    AT(hp_options, farthest);
    AT(hp_options, tensor);
    AT(hp_options, tensor_count);
    SIZE(hp_path_info);
    AT(hp_path_info, source);
    AT(hp_path_info, distance);
    SIZE(hp_array);
    AT(hp_array, data);
    AT(hp_array, count);
    AT(hp_array, byte_stride);
    SIZE(hp_mesh_options);
    AT(hp_mesh_options, user);
    AT(hp_mesh_options, weld);
    AT(hp_mesh_options, medium);
    AT(hp_mesh_options, values);
    AT(hp_mesh_options, time);
    AT(hp_mesh_options, farthest);
    AT(hp_mesh_options, curvature);
    AT(hp_mesh_options, bend);
    AT(hp_mesh_options, floor);
    AT(hp_mesh_options, reference);
    SIZE(hp_mesh_report);
    AT(hp_mesh_report, vertices);
    AT(hp_mesh_report, welded);
    AT(hp_mesh_report, euler_characteristic);
    SIZE(hp_surface_points);
    AT(hp_surface_points, curve);
    AT(hp_surface_points, vertices);
    AT(hp_surface_points, weights);
    AT(hp_surface_points, labels);
    AT(hp_surface_points, sets);
    return 0;
}
