/**
 * @class vtkHeatpathDistance
 * @brief The geodesic distance of each point of an image from the sources.
 *
 * The output is the image with the point array Distance, infinite where nothing was reached.
 */
#pragma once

#include "vtkHeatpathImageFilter.h"

class HEATPATHFILTERS_EXPORT vtkHeatpathDistance : public vtkHeatpathImageFilter
{
public:
  static vtkHeatpathDistance* New();
  vtkTypeMacro(vtkHeatpathDistance, vtkHeatpathImageFilter);

protected:
  vtkHeatpathDistance() = default;
  ~vtkHeatpathDistance() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkHeatpathDistance(const vtkHeatpathDistance&) = delete;
  void operator=(const vtkHeatpathDistance&) = delete;
};
