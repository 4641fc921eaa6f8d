#include "vtkHeatpathPath.h"

#include "HeatpathCall.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkHeatpathPath);

vtkHeatpathPath::vtkHeatpathPath()
{
    this->SetNumberOfInputPorts(3);
}

int vtkHeatpathPath::FillOutputPortInformation(int, vtkInformation *info)
{
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
    return 1;
}

int vtkHeatpathPath::RequestData(vtkInformation *, vtkInformationVector **inputs,
                                 vtkInformationVector *outputs)
{
    return callHeatpath(this, [&] {
        auto *image = vtkImageData::GetData(inputs[0]);
        auto *sources = vtkDataSet::GetData(inputs[1]), *ends = vtkDataSet::GetData(inputs[2]);
        auto *lines = vtkPolyData::GetData(outputs);
        const heatpath::Buffer buffer = this->Describe(image);
        const auto world = [&](const double *point, double *place) {
            this->ToWorld(image, point, place);
        };
        if (buffer.dimension == 2)
            makeLines(heatpath::paths<2>(buffer, this->ToPixels<2>(image, sources),
                                         this->ToPixels<2>(image, ends), this->Options()),
                      world, lines);
        else
            makeLines(heatpath::paths<3>(buffer, this->ToPixels<3>(image, sources),
                                         this->ToPixels<3>(image, ends), this->Options()),
                      world, lines);
    });
}
