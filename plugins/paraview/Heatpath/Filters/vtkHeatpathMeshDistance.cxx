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
    return callHeatpath(this, [&] {
        auto *surface = vtkPolyData::GetData(inputs[0]);
        const heatpath::MeshSolver solver = this->Prepare(surface);
        const heatpath::Points<3> places = pointsOf(vtkDataSet::GetData(inputs[1]));
        vtkNew<vtkDoubleArray> distances;
        distances->SetName("Distance");
        distances->SetNumberOfTuples(surface->GetNumberOfPoints());
        solver.distances(heatpath::SurfacePoints::positions(places), heatpath::array(distances),
                         this->Options());
        auto *output = vtkPolyData::GetData(outputs);
        output->ShallowCopy(surface);
        output->GetPointData()->AddArray(distances);
        output->GetPointData()->SetActiveScalars("Distance");
    });
}
