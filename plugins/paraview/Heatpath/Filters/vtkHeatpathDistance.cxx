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
    auto *image = vtkImageData::GetData(inputs[0]);
    auto *output = vtkImageData::GetData(outputs);
    hp_buffer buffer;
    if (!this->Describe(image, buffer))
        return 0;
    const auto sources = this->ToPixels(image, vtkDataSet::GetData(inputs[1]));
    const hp_options options = this->Options();
    vtkNew<vtkDoubleArray> distances;
    distances->SetName("Distance");
    distances->SetNumberOfTuples(image->GetNumberOfPoints());
    hp_buffer target;
    hp_buffer_init(&target, sizeof target);
    target.type = HP_F64;
    target.data = distances->GetPointer(0);
    target.dimension = buffer.dimension;
    std::copy_n(buffer.size, 3, target.size);
    const hp_status status = hp_distance(&buffer, nullptr, sources.data(),
                                         sources.size() / buffer.dimension, &options, &target);
    if (status == HP_CANCELLED)
        return 1;
    if (status != HP_OK) {
        vtkErrorMacro(<< hp_last_error_message());
        return 0;
    }
    output->ShallowCopy(image);
    output->GetPointData()->AddArray(distances);
    output->GetPointData()->SetActiveScalars("Distance");
    return 1;
}
