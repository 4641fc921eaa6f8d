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

struct hp_mesh;
struct hp_mesh_options;
struct hp_mesh_solver;

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
  hp_mesh_options Options();
  // Prepares distances on the surface; NULL and an error if that cannot be. To be freed with
  // hp_mesh_solver_free().
  hp_mesh_solver* Prepare(vtkPolyData* surface, const hp_mesh_options& options);
  // What RequestData returns: 0 and an error, unless the user has only cancelled.
  int Finish(int status);

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
