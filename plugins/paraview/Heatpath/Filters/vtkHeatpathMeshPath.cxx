#include "vtkHeatpathMeshPath.h"

#include "HeatpathCall.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>

vtkStandardNewMacro(vtkHeatpathMeshPath);

vtkHeatpathMeshPath::vtkHeatpathMeshPath()
{
    this->SetNumberOfInputPorts(3);
}

int vtkHeatpathMeshPath::RequestData(vtkInformation *, vtkInformationVector **inputs,
                                     vtkInformationVector *outputs)
{
    return callHeatpath(this, [&] {
        const heatpath::MeshSolver solver = this->Prepare(vtkPolyData::GetData(inputs[0]));
        const heatpath::Points<3> sources = pointsOf(vtkDataSet::GetData(inputs[1]));
        const heatpath::Points<3> ends = pointsOf(vtkDataSet::GetData(inputs[2]));
        heatpath::MeshOptions options = this->Options();
        options.shorten = this->Shorten;
        const auto paths = solver.paths(heatpath::SurfacePoints::positions(sources),
                                        heatpath::SurfacePoints::positions(ends), options);
        const auto world = [](const double *point, double *place) { std::copy_n(point, 3, place); };
        makeLines(paths, world, vtkPolyData::GetData(outputs));
    });
}
