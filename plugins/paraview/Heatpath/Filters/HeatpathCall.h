// What the filters share: progress, points, and paths as lines.
#pragma once

#include <vtkPolyData.h>

#include <heatpath.hpp>

#include <functional>
#include <vector>

class vtkDataSet;

// An hp_progress whose user is a vtkAlgorithm: shows the progress there, and cancels if it should.
int heatpathProgress(double finished, void *algorithm);

// x, y, z of the points of a data set, one after the other; none if it is NULL.
std::vector<double> pointsOf(vtkDataSet *data);

using ToWorld = std::function<void(const double *point, double *world)>;

// Fills `lines` with the paths and their cell arrays `end`, `source`, `length` and `distance`, as the
// command writes them to VTP files. dimension: the numbers of a point, which `world` places.
hp_status makeLines(const hp_paths *paths, int dimension, const ToWorld &world, vtkPolyData *lines);
