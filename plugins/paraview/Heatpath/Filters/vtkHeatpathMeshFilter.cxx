#include "vtkHeatpathMeshFilter.h"

#include "HeatpathCall.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

vtkHeatpathMeshFilter::vtkHeatpathMeshFilter()
{
    hp_mesh_options usual;
    hp_mesh_options_init(&usual, sizeof usual);
    this->Medium = static_cast<int>(usual.medium);
    this->Method = static_cast<int>(usual.method);
    this->Bend = static_cast<int>(usual.bend);
    this->SetNumberOfInputPorts(2);
}

int vtkHeatpathMeshFilter::FillInputPortInformation(int port, vtkInformation *info)
{
    info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkDataSet");
    return 1;
}

hp_mesh_options vtkHeatpathMeshFilter::Options()
{
    hp_mesh_options options;
    hp_mesh_options_init(&options, sizeof options);
    options.medium = static_cast<std::uint32_t>(this->Medium);
    options.method = static_cast<std::uint32_t>(this->Method);
    options.bend = static_cast<std::uint32_t>(this->Bend);
    options.farthest = this->Farthest;
    options.threads = static_cast<std::uint32_t>(std::max(this->Threads, 0));
    if (this->Weld >= 0)
        options.weld = this->Weld;
    options.progress = heatpathProgress;
    options.user = this;
    return options;
}

hp_mesh_solver *vtkHeatpathMeshFilter::Prepare(vtkPolyData *surface, const hp_mesh_options &options)
{
    if (surface->GetNumberOfStrips() > 0 || surface->GetNumberOfPolys() == 0) {
        vtkErrorMacro("the surface must have polygons and no strips: put Triangulate before");
        return nullptr;
    }
    const heatpath::Array points = heatpath::array(surface->GetPoints()->GetData());
    const heatpath::Array corners = heatpath::array(surface->GetPolys()->GetConnectivityArray());
    const heatpath::Array starts = heatpath::array(surface->GetPolys()->GetOffsetsArray());
    hp_mesh *mesh = nullptr;
    hp_mesh_solver *solver = nullptr;
    hp_status status = hp_mesh_create(&points, &corners, &starts, &options, &mesh);
    if (status == HP_OK)
        status = hp_mesh_solver_create(mesh, &options, &solver);
    hp_mesh_free(mesh);
    this->Finish(status);
    return solver;
}

int vtkHeatpathMeshFilter::Finish(int status)
{
    if (status == HP_OK || status == HP_CANCELLED)
        return 1;
    vtkErrorMacro(<< hp_last_error_message());
    return 0;
}
