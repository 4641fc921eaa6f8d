#include "vtkHeatpathDistance.h"

#include "HeatpathCall.h"

#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

#include <algorithm>

vtkStandardNewMacro(vtkHeatpathDistance);

int vtkHeatpathDistance::FillOutputPortInformation(int, vtkInformation *info)
{
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
    return 1;
}

int vtkHeatpathDistance::RequestData(vtkInformation *, vtkInformationVector **inputs,
                                     vtkInformationVector *outputs)
{
    return callHeatpath(this, [&] {
        auto *image = vtkImageData::GetData(inputs[0]);
        auto *points = vtkDataSet::GetData(inputs[1]);
        const heatpath::Buffer buffer = this->Describe(image);
        vtkNew<vtkDoubleArray> distances;
        distances->SetName("Distance");
        distances->SetNumberOfTuples(image->GetNumberOfPoints());
        heatpath::Buffer target(distances->GetPointer(0), {});
        target.dimension = buffer.dimension;
        std::copy_n(buffer.size, 3, target.size);
        if (buffer.dimension == 2)
            heatpath::distance(buffer, this->ToPixels<2>(image, points), target, this->Options());
        else
            heatpath::distance(buffer, this->ToPixels<3>(image, points), target, this->Options());
        auto *output = vtkImageData::GetData(outputs);
        output->ShallowCopy(image);
        output->GetPointData()->AddArray(distances);
        output->GetPointData()->SetActiveScalars("Distance");
    });
}
