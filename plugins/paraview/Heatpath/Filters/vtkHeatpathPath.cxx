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
    auto *image = vtkImageData::GetData(inputs[0]);
    hp_buffer buffer;
    if (!this->Describe(image, buffer))
        return 0;
    const auto sources = this->ToPixels(image, vtkDataSet::GetData(inputs[1]));
    const auto ends = this->ToPixels(image, vtkDataSet::GetData(inputs[2]));
    const hp_options options = this->Options();
    hp_paths *paths = nullptr;
    hp_status status = hp_paths_create(&buffer, nullptr, sources.data(),
                                       sources.size() / buffer.dimension, ends.data(),
                                       ends.size() / buffer.dimension, &options, &paths);
    if (status == HP_OK) {
        const auto world = [&](const double *point, double *place) {
            this->ToWorld(image, point, place);
        };
        const int dimension = static_cast<int>(buffer.dimension);
        status = makeLines(paths, dimension, world, vtkPolyData::GetData(outputs));
    }
    hp_paths_free(paths);
    if (status == HP_OK || status == HP_CANCELLED)
        return 1;
    vtkErrorMacro(<< hp_last_error_message());
    return 0;
}
