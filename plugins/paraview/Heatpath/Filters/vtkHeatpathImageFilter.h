/**
 * @class vtkHeatpathImageFilter
 * @brief What the filters on images share: the medium, and where points lie in the image.
 *
 * Port 0 is a vtkImageData with point scalars (the array to process), flat in one direction or not;
 * port 1 a vtkDataSet whose points are the sources, in world coordinates.
 */
#pragma once

#include "HeatpathFiltersModule.h"

#include <vtkDataObjectAlgorithm.h>

#include <array>
#include <cstddef>
#include <vector>

class vtkDataSet;
class vtkImageData;

namespace heatpath
{
struct Buffer;
struct Options;
}

class HEATPATHFILTERS_EXPORT vtkHeatpathImageFilter : public vtkDataObjectAlgorithm
{
public:
  vtkTypeMacro(vtkHeatpathImageFilter, vtkDataObjectAlgorithm);

  ///@{
  /** As the fields of hp_options, whose constants these are; 0 where the medium decides. */
  vtkSetMacro(Medium, int);
  vtkGetMacro(Medium, int);
  vtkSetMacro(Power, double);
  vtkGetMacro(Power, double);
  vtkSetMacro(Floor, double);
  vtkGetMacro(Floor, double);
  vtkSetMacro(Contrast, double);
  vtkGetMacro(Contrast, double);
  vtkSetMacro(EdgeStop, int);
  vtkGetMacro(EdgeStop, int);
  vtkSetMacro(Smoothing, double);
  vtkGetMacro(Smoothing, double);
  vtkSetMacro(Estimator, int);
  vtkGetMacro(Estimator, int);
  vtkSetMacro(Solver, int);
  vtkGetMacro(Solver, int);
  vtkSetMacro(Iterations, int);
  vtkGetMacro(Iterations, int);
  vtkSetMacro(Time, double);
  vtkGetMacro(Time, double);
  vtkSetMacro(Farthest, double);
  vtkGetMacro(Farthest, double);
  vtkSetMacro(Threads, int);
  vtkGetMacro(Threads, int);
  vtkSetMacro(Directions, int);
  vtkGetMacro(Directions, int);
  vtkSetMacro(Polarity, int);
  vtkGetMacro(Polarity, int);
  vtkSetMacro(Anisotropy, double);
  vtkGetMacro(Anisotropy, double);
  vtkSetMacro(Elongation, double);
  vtkGetMacro(Elongation, double);
  vtkSetMacro(Normalize, double);
  vtkGetMacro(Normalize, double);
  ///@}

  ///@{
  /** The half widths of tubes, in pixels; the medium's own if there are none. */
  void AddScale(double scale);
  void ClearScales();
  ///@}

  ///@{
  /** The component of the scalars that is the image. */
  vtkSetMacro(Component, int);
  vtkGetMacro(Component, int);
  ///@}

  ///@{
  /** Whether Range, and not the type or values of the image, says what becomes grey value 0 and 1. */
  vtkSetMacro(UseRange, bool);
  vtkGetMacro(UseRange, bool);
  vtkSetVector2Macro(Range, double);
  vtkGetVector2Macro(Range, double);
  ///@}

  ///@{
  /** The grey value that the image is compared with; negative: that of the sources. */
  vtkSetMacro(Reference, double);
  vtkGetMacro(Reference, double);
  ///@}

protected:
  vtkHeatpathImageFilter();
  ~vtkHeatpathImageFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  // The options, with this filter's progress.
  heatpath::Options Options();
  // The image where it is; throws if heatpath cannot take it. Fills Axes.
  heatpath::Buffer Describe(vtkImageData* image);
  // The points of a data set in pixel coordinates along Axes, of which there are N.
  template <std::size_t N>
  std::vector<std::array<double, N>> ToPixels(vtkImageData* image, vtkDataSet* points) const;
  // And back.
  void ToWorld(vtkImageData* image, const double* point, double* world) const;

  // The axes of the image that are longer than one pixel: two or three.
  std::vector<int> Axes;

private:
  vtkHeatpathImageFilter(const vtkHeatpathImageFilter&) = delete;
  void operator=(const vtkHeatpathImageFilter&) = delete;

  // Fills what is about the medium.
  void DescribeMedium(heatpath::Options& options) const;

  int Medium;
  double Power = 0;
  double Floor = 0;
  double Contrast = 0;
  int EdgeStop;
  double Smoothing = 0;
  int Directions;
  int Polarity;
  double Anisotropy = 0;
  double Elongation = 0;
  double Normalize = 0;
  std::vector<double> Scales;
  int Estimator;
  int Solver;
  int Iterations = 0;
  double Time = 0;
  double Farthest = 0;
  int Threads = 0;
  int Component = 0;
  bool UseRange = false;
  double Range[2] = { 0, 1 };
  double Reference = -1;
};
