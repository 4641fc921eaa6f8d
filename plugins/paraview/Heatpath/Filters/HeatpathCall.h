// What the filters share: VTK's memory described to heatpath, and paths as lines.
#pragma once

#include <heatpath.h>

#include <cstdint>
#include <functional>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkPolyData;

// HP_U8, ...; 0 if heatpath has no such type.
std::uint32_t heatpathType(vtkDataArray *array);

// The tuples of an array where they are.
hp_array describeTuples(vtkDataArray *array);

// Items of `width` numbers each.
hp_array describeNumbers(const std::vector<double> &numbers, int width);

// An hp_progress whose user is a vtkAlgorithm: shows the progress there, and cancels if it should.
int heatpathProgress(double finished, void *algorithm);

// x, y, z of the points of a data set, one after the other; none if it is NULL.
std::vector<double> pointsOf(vtkDataSet *data);

using ToWorld = std::function<void(const double *point, double *world)>;

// Fills `lines` with the paths and their cell arrays `end`, `source`, `length` and `distance`, as the
// command writes them to VTP files. dimension: the numbers of a point, which `world` places.
hp_status makeLines(const hp_paths *paths, int dimension, const ToWorld &world, vtkPolyData *lines);
