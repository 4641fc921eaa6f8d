#include "vtkHeatpathImageFilter.h"

#include "HeatpathCall.h"

#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <stdexcept>
#include <string>

vtkHeatpathImageFilter::vtkHeatpathImageFilter()
{
    const heatpath::Options usual;
    this->Medium = static_cast<int>(usual.medium);
    this->EdgeStop = static_cast<int>(usual.edge_stop);
    this->Directions = static_cast<int>(usual.directions);
    this->Polarity = static_cast<int>(usual.polarity);
    this->Estimator = static_cast<int>(usual.estimator);
    this->Solver = static_cast<int>(usual.solver);
    this->SetNumberOfInputPorts(2);
    this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
}

int vtkHeatpathImageFilter::FillInputPortInformation(int port, vtkInformation *info)
{
    info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkDataSet");
    return 1;
}

// All of the image is needed, whatever part of the result is asked for.
int vtkHeatpathImageFilter::RequestUpdateExtent(vtkInformation *, vtkInformationVector **inputs,
                                                vtkInformationVector *)
{
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation *info = inputs[0]->GetInformationObject(0);
    int whole[6];
    info->Get(Pipeline::WHOLE_EXTENT(), whole);
    info->Set(Pipeline::UPDATE_EXTENT(), whole, 6);
    return 1;
}

void vtkHeatpathImageFilter::AddScale(double scale)
{
    this->Scales.push_back(scale);
    this->Modified();
}

void vtkHeatpathImageFilter::ClearScales()
{
    this->Scales.clear();
    this->Modified();
}

void vtkHeatpathImageFilter::DescribeMedium(heatpath::Options &options) const
{
    options.medium = static_cast<std::uint32_t>(this->Medium);
    if (this->Power != 0)
        options.power = this->Power;
    if (this->Floor != 0)
        options.floor = this->Floor;
    if (this->Contrast != 0)
        options.contrast = this->Contrast;
    if (this->Reference >= 0)
        options.reference = this->Reference;
    if (this->UseRange) {
        options.range_low = this->Range[0];
        options.range_high = this->Range[1];
    }
    options.edge_stop = static_cast<std::uint32_t>(this->EdgeStop);
    options.smoothing = this->Smoothing;
    options.directions = static_cast<std::uint32_t>(this->Directions);
    options.polarity = static_cast<std::uint32_t>(this->Polarity);
    options.anisotropy = this->Anisotropy;
    options.elongation = this->Elongation;
    options.normalize = this->Normalize;
    options.scales = this->Scales.data();
    options.scale_count = this->Scales.size();
}

heatpath::Options vtkHeatpathImageFilter::Options()
{
    heatpath::Options options;
    this->DescribeMedium(options);
    options.estimator = static_cast<std::uint32_t>(this->Estimator);
    options.solver = static_cast<std::uint32_t>(this->Solver);
    options.iterations = static_cast<std::uint64_t>(std::max(this->Iterations, 0));
    options.time = this->Time;
    options.farthest = this->Farthest;
    options.threads = static_cast<std::uint32_t>(std::max(this->Threads, 0));
    options.on_progress = progressOf(this);
    return options;
}

heatpath::Buffer vtkHeatpathImageFilter::Describe(vtkImageData *image)
{
    vtkDataArray *scalars = this->GetInputArrayToProcess(0, image);
    if (!scalars || scalars->GetNumberOfTuples() != image->GetNumberOfPoints() || this->Component < 0 ||
        this->Component >= scalars->GetNumberOfComponents())
        throw std::invalid_argument("Scalars: the image has no point array of that name with a component " +
                                    std::to_string(this->Component));
    heatpath::Buffer buffer;
    buffer.type = heatpath::type_of_vtk(scalars->GetDataType());
    const int bytes = scalars->GetDataTypeSize();
    buffer.data = static_cast<char *>(scalars->GetVoidPointer(0)) + this->Component * bytes;
    const int *size = image->GetDimensions();
    std::int64_t stride = static_cast<std::int64_t>(bytes) * scalars->GetNumberOfComponents();
    this->Axes.clear();
    for (int axis = 0; axis < 3; axis++) {
        if (size[axis] > 1) {
            const std::size_t own = this->Axes.size();
            buffer.size[own] = static_cast<std::uint64_t>(size[axis]);
            buffer.byte_stride[own] = stride;
            buffer.spacing[own] = image->GetSpacing()[axis];
            this->Axes.push_back(axis);
        }
        stride *= size[axis];
    }
    if (this->Axes.size() < 2)
        throw std::invalid_argument("the image is a line: it has " + std::to_string(size[0]) + " x " +
                                    std::to_string(size[1]) + " x " + std::to_string(size[2]) +
                                    " points");
    buffer.dimension = static_cast<std::uint32_t>(this->Axes.size());
    return buffer;
}

template <std::size_t N>
heatpath::Points<N> vtkHeatpathImageFilter::ToPixels(vtkImageData *image, vtkDataSet *points) const
{
    heatpath::Points<N> pixels;
    for (const auto &world : pointsOf(points)) {
        double index[3];
        image->TransformPhysicalPointToContinuousIndex(world.data(), index);
        auto &pixel = pixels.emplace_back();
        for (std::size_t own = 0; own < N; own++)
            pixel[own] = index[this->Axes[own]] - image->GetExtent()[2 * this->Axes[own]];
    }
    return pixels;
}

template heatpath::Points<2> vtkHeatpathImageFilter::ToPixels<2>(vtkImageData *, vtkDataSet *) const;
template heatpath::Points<3> vtkHeatpathImageFilter::ToPixels<3>(vtkImageData *, vtkDataSet *) const;

void vtkHeatpathImageFilter::ToWorld(vtkImageData *image, const double *point, double *world) const
{
    const int *extent = image->GetExtent();
    double index[3];
    for (int axis = 0; axis < 3; axis++)
        index[axis] = extent[2 * axis];
    for (std::size_t own = 0; own < this->Axes.size(); own++)
        index[this->Axes[own]] += point[own];
    image->TransformContinuousIndexToPhysicalPoint(index, world);
}
