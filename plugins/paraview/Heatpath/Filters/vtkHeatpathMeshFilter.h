/**
 * @class vtkHeatpathMeshFilter
 * @brief What the filters on surfaces share: the mesh, the medium and the method.
 *
 * Port 0 is a vtkPolyData of any polygons; port 1 a vtkDataSet whose points are the sources: the
 * nearest points of the surface are taken.
 */
#pragma once

#include "HeatpathFiltersModule.h"

#include <vtkPolyDataAlgorithm.h>

namespace heatpath
{
struct MeshOptions;
class MeshSolver;
}

class HEATPATHFILTERS_EXPORT vtkHeatpathMeshFilter : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkHeatpathMeshFilter, vtkPolyDataAlgorithm);

  ///@{
  /** As the fields of hp_mesh_options, whose constants these are. */
  vtkSetMacro(Medium, int);
  vtkGetMacro(Medium, int);
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  vtkSetMacro(Bend, int);
  vtkGetMacro(Bend, int);
  vtkSetMacro(Farthest, double);
  vtkGetMacro(Farthest, double);
  vtkSetMacro(Threads, int);
  vtkGetMacro(Threads, int);
  ///@}

  ///@{
  /** Vertices at most this far apart are joined; negative: none are. */
  vtkSetMacro(Weld, double);
  vtkGetMacro(Weld, double);
  ///@}

protected:
  vtkHeatpathMeshFilter();
  ~vtkHeatpathMeshFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  // The options, with this filter's progress.
  heatpath::MeshOptions Options();
  // Prepares distances on the surface; throws if that cannot be. What is computed then with Options()
  // is the second half of the progress.
  heatpath::MeshSolver Prepare(vtkPolyData* surface);

private:
  vtkHeatpathMeshFilter(const vtkHeatpathMeshFilter&) = delete;
  void operator=(const vtkHeatpathMeshFilter&) = delete;

  int Medium;
  int Method;
  int Bend;
  double Farthest = 0;
  int Threads = 0;
  double Weld = -1;
};
