// The minimal path between two points of a volume, with VTK.
//
//     trace VOLUME.vti SOURCE_X,Y,Z END_X,Y,Z OUTPUT
//
// Points are physical: where origin, spacing and direction of the volume have put its points. Writes
// OUTPUT.vti, the distance of each point from the source on the same grid, and OUTPUT.vtp, the path.
// Prints the points of the path as indices into the volume, counted from its first point.
#include "line.h"

#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include <heatpath.hpp>

#include <cstdio>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace {

using Point = heatpath::Point<3>;
using Points = heatpath::Points<3>;

// VTK counts indices from the begin of the extent of an image, heatpath from its first point.
Points index(vtkImageData *image, const std::string &text)
{
    Point place, result;
    std::istringstream stream(text);
    char comma = 0;
    if (!(stream >> place[0] >> comma >> place[1] >> comma >> place[2]))
        throw std::runtime_error(text + " should be three numbers");
    image->TransformPhysicalPointToContinuousIndex(place.data(), result.data());
    for (int axis = 0; axis < 3; ++axis)
        result[axis] -= image->GetExtent()[2 * axis];
    return {result};
}

Point physical(vtkImageData *image, Point index)
{
    for (int axis = 0; axis < 3; ++axis)
        index[axis] += image->GetExtent()[2 * axis];
    Point result;
    image->TransformContinuousIndexToPhysicalPoint(index.data(), result.data());
    return result;
}

void write_distances(vtkImageData *image, const Points &sources, const std::string &name)
{
    vtkNew<vtkImageData> distances;
    distances->CopyStructure(image);
    distances->AllocateScalars(VTK_DOUBLE, 1);
    distances->GetPointData()->GetScalars()->SetName("distance");
    heatpath::distance(heatpath::buffer(image), sources, heatpath::buffer(distances));
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputData(distances);
    writer->SetFileName(name.c_str());
    writer->SetCompressorTypeToNone();
    writer->EncodeAppendedDataOff();
    if (!writer->Write())
        throw std::runtime_error(name + " cannot be written");
}

void trace(char **arguments)
{
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(arguments[0]);
    reader->Update();
    vtkImageData *image = reader->GetOutput();
    if (!image->GetPointData()->GetScalars())
        throw std::runtime_error(std::string(arguments[0]) + " has no scalars");
    const Points sources = index(image, arguments[1]), ends = index(image, arguments[2]);
    const std::string output = arguments[3];
    write_distances(image, sources, output + ".vti");

    // From the end to the source; without the source if there is no way to it.
    heatpath::Path<3> path = heatpath::paths<3>(heatpath::buffer(image), sources, ends)[0];
    for (Point &point : path.points) {
        std::printf("%.17g,%.17g,%.17g\n", point[0], point[1], point[2]);
        point = physical(image, point);
    }
    write_line(path.points, output + ".vtp");
}

} // namespace

int main(int count, char **arguments)
{
    if (count != 5) {
        std::cerr << "usage: trace VOLUME.vti SOURCE_X,Y,Z END_X,Y,Z OUTPUT\n";
        return 2;
    }
    try {
        trace(arguments + 1);
    } catch (const std::exception &error) {
        std::cerr << "trace: " << error.what() << '\n';
        return 1;
    }
}
