#include "HeatpathCall.h"

#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <map>
#include <string>

int heatpathProgress(double finished, void *algorithm)
{
    auto *self = static_cast<vtkAlgorithm *>(algorithm);
    self->UpdateProgress(finished);
    return self->GetAbortExecute();
}

std::vector<double> pointsOf(vtkDataSet *data)
{
    std::vector<double> coordinates;
    const vtkIdType count = data ? data->GetNumberOfPoints() : 0;
    for (vtkIdType i = 0; i < count; i++) {
        double point[3];
        data->GetPoint(i, point);
        coordinates.insert(coordinates.end(), point, point + 3);
    }
    return coordinates;
}

namespace {

// Arrays of the lines by name, made when they are first filled.
class Columns {
  public:
    void add(const char *name, double value)
    {
        auto &column = this->columns[name];
        if (!column) {
            column = vtkSmartPointer<vtkDoubleArray>::New();
            column->SetName(name);
        }
        column->InsertNextValue(value);
    }

    void moveTo(vtkPolyData *lines) const
    {
        for (const auto &[name, column] : this->columns)
            lines->GetCellData()->AddArray(column);
    }

  private:
    std::map<std::string, vtkSmartPointer<vtkDoubleArray>> columns;
};

void addLine(const std::vector<double> &line, int dimension, const ToWorld &world,
             vtkPoints *points, vtkCellArray *cells)
{
    const auto count = static_cast<vtkIdType>(line.size()) / dimension;
    cells->InsertNextCell(static_cast<int>(count));
    for (vtkIdType i = 0; i < count; i++) {
        double place[3];
        world(&line[i * dimension], place);
        cells->InsertCellPoint(points->InsertNextPoint(place));
    }
}

} // namespace

hp_status makeLines(const hp_paths *paths, int dimension, const ToWorld &world, vtkPolyData *lines)
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    Columns columns;
    std::uint64_t count = 0;
    hp_status status = hp_paths_count(paths, &count);
    for (std::uint64_t i = 0; i < count && status == HP_OK; i++) {
        hp_path_info info;
        info.struct_size = sizeof info;
        status = hp_paths_info(paths, i, &info);
        if (status != HP_OK)
            break;
        std::vector<double> line(info.point_count * dimension);
        status = hp_paths_points(paths, i, line.data(), info.point_count);
        addLine(line, dimension, world, points, cells);
        columns.add("end", static_cast<double>(i));
        columns.add("source", static_cast<double>(info.source));
        columns.add("length", info.physical_length);
        columns.add("distance", std::isfinite(info.distance) ? info.distance : -1);
    }
    lines->SetPoints(points);
    lines->SetLines(cells);
    columns.moveTo(lines);
    return status;
}
