#include "HeatpathCall.h"

#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkPoints.h>

#include <cmath>
#include <exception>
#include <utility>

int callHeatpath(vtkAlgorithm *filter, const std::function<void()> &work)
{
    try {
        work();
        return 1;
    } catch (const heatpath::Error &error) {
        if (error.status() == HP_CANCELLED)
            return 1;
        vtkErrorWithObjectMacro(filter, << error.what());
    } catch (const std::exception &error) {
        vtkErrorWithObjectMacro(filter, << error.what());
    }
    return 0;
}

std::function<bool(double)> progressOf(vtkAlgorithm *filter, double begin, double end)
{
    return [=](double finished) {
        filter->UpdateProgress(begin + (end - begin) * finished);
        return !filter->GetAbortExecute();
    };
}

heatpath::Points<3> pointsOf(vtkDataSet *data)
{
    heatpath::Points<3> points(data ? data->GetNumberOfPoints() : 0);
    for (std::size_t i = 0; i < points.size(); i++)
        data->GetPoint(static_cast<vtkIdType>(i), points[i].data());
    return points;
}

Lines::Lines(ToWorld place)
    : world(std::move(place)), points(vtkSmartPointer<vtkPoints>::New()),
      cells(vtkSmartPointer<vtkCellArray>::New())
{
    this->points->SetDataTypeToDouble();
    const char *names[] = {"end", "source", "length", "distance"};
    for (int i = 0; i < 4; i++) {
        this->columns[i] = vtkSmartPointer<vtkDoubleArray>::New();
        this->columns[i]->SetName(names[i]);
    }
}

void Lines::add(const hp_path_info &info, const double *coordinates, int dimension)
{
    const auto end = static_cast<double>(this->cells->GetNumberOfCells());
    this->cells->InsertNextCell(static_cast<int>(info.point_count));
    for (std::uint64_t i = 0; i < info.point_count; i++) {
        double place[3];
        this->world(coordinates + i * dimension, place);
        this->cells->InsertCellPoint(this->points->InsertNextPoint(place));
    }
    const double distance = std::isfinite(info.distance) ? info.distance : -1;
    const double values[] = {end, static_cast<double>(info.source), info.physical_length, distance};
    for (int i = 0; i < 4; i++)
        this->columns[i]->InsertNextValue(values[i]);
}

void Lines::end(vtkPolyData *lines) const
{
    lines->SetPoints(this->points);
    lines->SetLines(this->cells);
    for (const auto &column : this->columns)
        lines->GetCellData()->AddArray(column);
}
