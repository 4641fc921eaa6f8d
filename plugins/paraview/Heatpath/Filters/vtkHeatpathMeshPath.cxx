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
    hp_mesh_options options = this->Options();
    options.shorten = this->Shorten;
    hp_mesh_solver *solver = this->Prepare(vtkPolyData::GetData(inputs[0]), options);
    if (!solver)
        return this->GetAbortExecute();
    const auto places = pointsOf(vtkDataSet::GetData(inputs[1]));
    const auto endPlaces = pointsOf(vtkDataSet::GetData(inputs[2]));
    const heatpath::Array positions(places.data(), places.size() / 3);
    const heatpath::Array endPositions(endPlaces.data(), endPlaces.size() / 3);
    hp_surface_points sources;
    hp_surface_points_init(&sources, sizeof sources);
    hp_surface_points ends = sources;
    sources.positions = &positions;
    ends.positions = &endPositions;
    hp_paths *paths = nullptr;
    hp_status status = hp_mesh_paths_create(solver, &sources, &ends, &options, &paths);
    if (status == HP_OK) {
        const auto world = [](const double *point, double *place) { std::copy_n(point, 3, place); };
        status = makeLines(paths, 3, world, vtkPolyData::GetData(outputs));
    }
    hp_paths_free(paths);
    hp_mesh_solver_free(solver);
    return this->Finish(status);
}
