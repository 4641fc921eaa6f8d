#include "vtkHeatpathMeshDistance.h"

#include "HeatpathCall.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkHeatpathMeshDistance);

int vtkHeatpathMeshDistance::RequestData(vtkInformation *, vtkInformationVector **inputs,
                                         vtkInformationVector *outputs)
{
    auto *surface = vtkPolyData::GetData(inputs[0]);
    auto *output = vtkPolyData::GetData(outputs);
    const hp_mesh_options options = this->Options();
    hp_mesh_solver *solver = this->Prepare(surface, options);
    if (!solver)
        return this->GetAbortExecute();
    const auto places = pointsOf(vtkDataSet::GetData(inputs[1]));
    const heatpath::Array positions(places.data(), places.size() / 3);
    hp_surface_points sources;
    hp_surface_points_init(&sources, sizeof sources);
    sources.positions = &positions;
    vtkNew<vtkDoubleArray> distances;
    distances->SetName("Distance");
    distances->SetNumberOfTuples(surface->GetNumberOfPoints());
    const heatpath::Array target = heatpath::array(distances);
    const hp_status status =
        hp_mesh_solver_distances(solver, &sources, &options, &target, 0, nullptr, 0);
    hp_mesh_solver_free(solver);
    if (status != HP_OK)
        return this->Finish(status);
    output->ShallowCopy(surface);
    output->GetPointData()->AddArray(distances);
    output->GetPointData()->SetActiveScalars("Distance");
    return 1;
}
