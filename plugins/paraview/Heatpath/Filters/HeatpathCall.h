// What the filters share: failures, progress, points, and paths as lines.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <heatpath.hpp>

#include <functional>
#include <vector>

class vtkAlgorithm;
class vtkCellArray;
class vtkDataSet;
class vtkDoubleArray;
class vtkPoints;

// Runs `work`; what it throws becomes an error of the filter, unless the user has only cancelled.
// Returns what RequestData does.
int callHeatpath(vtkAlgorithm *filter, const std::function<void()> &work);

// A heatpath::Options::on_progress that shows the part from `begin` to `end` of a filter's work, and
// cancels if the filter should.
std::function<bool(double)> progressOf(vtkAlgorithm *filter, double begin = 0, double end = 1);

// The points of a data set; none if it is NULL.
heatpath::Points<3> pointsOf(vtkDataSet *data);

using ToWorld = std::function<void(const double *point, double *world)>;

// Paths as lines, which end() gives to a data set with the cell arrays `end`, `source`, `length` and
// `distance`, as the command writes them to VTP files.
class Lines {
  public:
    explicit Lines(ToWorld place);
    void add(const hp_path_info &info, const double *coordinates, int dimension);
    void end(vtkPolyData *lines) const;

  private:
    ToWorld world;
    vtkSmartPointer<vtkPoints> points;
    vtkSmartPointer<vtkCellArray> cells;
    vtkSmartPointer<vtkDoubleArray> columns[4];
};

// Fills `lines` with the paths, whose points `world` places.
template <class Path>
void makeLines(const std::vector<Path> &paths, const ToWorld &world, vtkPolyData *lines)
{
    Lines result(world);
    for (const Path &path : paths)
        result.add(path.info, path.points.front().data(), static_cast<int>(path.points.front().size()));
    result.end(lines);
}
