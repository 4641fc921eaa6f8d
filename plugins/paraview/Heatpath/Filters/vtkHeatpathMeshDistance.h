/**
 * @class vtkHeatpathMeshDistance
 * @brief The geodesic distance of each point of a surface from the sources.
 *
 * The output is the surface with the point array Distance, infinite where nothing was reached.
 */
#pragma once

#include "vtkHeatpathMeshFilter.h"

class HEATPATHFILTERS_EXPORT vtkHeatpathMeshDistance : public vtkHeatpathMeshFilter
{
public:
  static vtkHeatpathMeshDistance* New();
  vtkTypeMacro(vtkHeatpathMeshDistance, vtkHeatpathMeshFilter);

protected:
  vtkHeatpathMeshDistance() = default;
  ~vtkHeatpathMeshDistance() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkHeatpathMeshDistance(const vtkHeatpathMeshDistance&) = delete;
  void operator=(const vtkHeatpathMeshDistance&) = delete;
};
