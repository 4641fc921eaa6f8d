/**
 * @class vtkHeatpathPath
 * @brief Minimal paths through an image, from end points to the sources.
 *
 * Port 2 is a vtkDataSet whose points are the ends. The output has a line for each end, which
 * begins there, with the cell arrays end, source, length and distance; source and distance are -1
 * where there is no path.
 */
#pragma once

#include "vtkHeatpathImageFilter.h"

class HEATPATHFILTERS_EXPORT vtkHeatpathPath : public vtkHeatpathImageFilter
{
public:
  static vtkHeatpathPath* New();
  vtkTypeMacro(vtkHeatpathPath, vtkHeatpathImageFilter);

protected:
  vtkHeatpathPath();
  ~vtkHeatpathPath() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkHeatpathPath(const vtkHeatpathPath&) = delete;
  void operator=(const vtkHeatpathPath&) = delete;
};
