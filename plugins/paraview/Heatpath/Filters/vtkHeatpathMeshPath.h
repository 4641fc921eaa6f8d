/**
 * @class vtkHeatpathMeshPath
 * @brief Shortest paths on a surface, from end points to the sources.
 *
 * Port 2 is a vtkDataSet whose points are the ends. The output has a line for each end, as that of
 * vtkHeatpathPath.
 */
#pragma once

#include "vtkHeatpathMeshFilter.h"

class HEATPATHFILTERS_EXPORT vtkHeatpathMeshPath : public vtkHeatpathMeshFilter
{
public:
  static vtkHeatpathMeshPath* New();
  vtkTypeMacro(vtkHeatpathMeshPath, vtkHeatpathMeshFilter);

  ///@{
  /** Whether paths are made straight across all edges; in the uniform medium only. */
  vtkSetMacro(Shorten, bool);
  vtkGetMacro(Shorten, bool);
  ///@}

protected:
  vtkHeatpathMeshPath();
  ~vtkHeatpathMeshPath() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkHeatpathMeshPath(const vtkHeatpathMeshPath&) = delete;
  void operator=(const vtkHeatpathMeshPath&) = delete;

  bool Shorten = false;
};
