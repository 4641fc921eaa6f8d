#include "vtkHeatpathMeshFilter.h"

#include "HeatpathCall.h"

#include <vtkInformation.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <stdexcept>

vtkHeatpathMeshFilter::vtkHeatpathMeshFilter()
{
    const heatpath::MeshOptions usual;
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

heatpath::MeshOptions vtkHeatpathMeshFilter::Options()
{
    heatpath::MeshOptions options;
    options.medium = static_cast<std::uint32_t>(this->Medium);
    options.method = static_cast<std::uint32_t>(this->Method);
    options.bend = static_cast<std::uint32_t>(this->Bend);
    options.farthest = this->Farthest;
    options.threads = static_cast<std::uint32_t>(std::max(this->Threads, 0));
    if (this->Weld >= 0)
        options.weld = this->Weld;
    options.on_progress = progressOf(this, 0.5, 1);
    return options;
}

heatpath::MeshSolver vtkHeatpathMeshFilter::Prepare(vtkPolyData *surface)
{
    if (surface->GetNumberOfStrips() > 0 || surface->GetNumberOfPolys() == 0)
        throw std::invalid_argument(
            "the surface must have polygons and no strips: put Triangulate before");
    heatpath::MeshOptions options = this->Options();
    options.on_progress = progressOf(this, 0, 0.1);
    const heatpath::Mesh mesh = heatpath::mesh(surface, options);
    options.on_progress = progressOf(this, 0.1, 0.5);
    return heatpath::MeshSolver(mesh, options);
}
