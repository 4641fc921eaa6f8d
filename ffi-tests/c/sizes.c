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
    AT(hp_options, directions);
    AT(hp_options, scales);
    AT(hp_options, margin);
    SIZE(hp_path_info);
    AT(hp_path_info, source);
    AT(hp_path_info, distance);
    AT(hp_path_info, cost);
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
    AT(hp_mesh_options, iterations);
    AT(hp_mesh_options, step);
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
    SIZE(hp_vote_options);
    AT(hp_vote_options, structure);
    AT(hp_vote_options, no_growth);
    AT(hp_vote_options, gap);
    AT(hp_vote_options, prune);
    SIZE(hp_key_point_options);
    AT(hp_key_point_options, structure);
    AT(hp_key_point_options, iterations);
    SIZE(hp_graph_info);
    AT(hp_graph_info, node_count);
    AT(hp_graph_info, physical_length);
    AT(hp_graph_info, stop);
    SIZE(hp_graph_node);
    AT(hp_graph_node, point);
    AT(hp_graph_node, radius);
    AT(hp_graph_node, parent);
    SIZE(hp_graph_branch);
    AT(hp_graph_branch, from);
    AT(hp_graph_branch, length);
    AT(hp_graph_branch, mean_radius);
    SIZE(hp_curves);
    AT(hp_curves, dimension);
    AT(hp_curves, points);
    AT(hp_curves, spacing);
    AT(hp_curves, mask);
    SIZE(hp_score);
    AT(hp_score, recall);
    AT(hp_score, extracted_distance);
    return 0;
}
