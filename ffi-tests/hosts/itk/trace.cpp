// The minimal path between two points of the patient in a volume, with ITK.
//
//     trace VOLUME SOURCE_X,Y,Z END_X,Y,Z OUTPUT
//
// The volume is a file that ITK reads, of short or float; points are physical, where origin, spacing
// and direction of the volume have put its voxels. Writes OUTPUT.mha, the distance of each voxel from
// the source, in the volume's place, and OUTPUT.csv, the points of the path. Prints them as
// indices too, which heatpath counts from the first voxel in memory.
#include <itkContinuousIndex.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>
#include <itkImageIOFactory.h>

#include <heatpath.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace {

using Distances = itk::Image<double, 3>;
using Place = Distances::PointType;
using Index = itk::ContinuousIndex<double, 3>;

Place place(const std::string &text)
{
    Place result;
    std::istringstream stream(text);
    char comma = 0;
    if (!(stream >> result[0] >> comma >> result[1] >> comma >> result[2]))
        throw std::runtime_error(text + " should be three numbers");
    return result;
}

// ITK counts indices from anywhere, heatpath from the first voxel in memory.
template <class Image>
heatpath::Points<3> index(const Image *image, const std::string &text)
{
    Index from_itk;
    if (!image->TransformPhysicalPointToContinuousIndex(place(text), from_itk))
        throw std::runtime_error(text + " lies outside the volume");
    heatpath::Point<3> result;
    for (unsigned axis = 0; axis < 3; ++axis)
        result[axis] = from_itk[axis] - image->GetBufferedRegion().GetIndex(axis);
    return {result};
}

template <class Image> Place physical(const Image *image, const heatpath::Point<3> &point)
{
    Index for_itk;
    for (unsigned axis = 0; axis < 3; ++axis)
        for_itk[axis] = point[axis] + image->GetBufferedRegion().GetIndex(axis);
    Place result;
    image->TransformContinuousIndexToPhysicalPoint(for_itk, result);
    return result;
}

template <class Image>
void write_distances(Image *image, const heatpath::Points<3> &sources, const std::string &name)
{
    const auto distances = Distances::New();
    distances->CopyInformation(image);
    distances->SetRegions(image->GetBufferedRegion());
    distances->Allocate();
    heatpath::distance(heatpath::buffer(image), sources, heatpath::buffer(distances.GetPointer()));
    itk::WriteImage(distances, name);
}

template <class Pixel> void trace(char **arguments)
{
    const auto image = itk::ReadImage<itk::Image<Pixel, 3>>(arguments[0]);
    const heatpath::Points<3> sources = index(image.GetPointer(), arguments[1]);
    const heatpath::Points<3> ends = index(image.GetPointer(), arguments[2]);
    const std::string output = arguments[3];
    write_distances(image.GetPointer(), sources, output + ".mha");

    // From the end to the source; without the source if there is no way to it.
    const auto path = heatpath::paths<3>(heatpath::buffer(image.GetPointer()), sources, ends)[0];
    std::ofstream csv(output + ".csv");
    csv.exceptions(std::ios::failbit | std::ios::badbit);
    csv.precision(17);
    csv << "x,y,z\n";
    for (const heatpath::Point<3> &point : path.points) {
        std::printf("%.17g,%.17g,%.17g\n", point[0], point[1], point[2]);
        const Place at = physical(image.GetPointer(), point);
        csv << at[0] << ',' << at[1] << ',' << at[2] << '\n';
    }
}

// Reads the volume in the type of its file.
void trace_any(char **arguments)
{
    const auto file = itk::ImageIOFactory::CreateImageIO(
        arguments[0], itk::ImageIOFactory::IOFileModeEnum::ReadMode);
    if (!file)
        throw std::runtime_error(std::string(arguments[0]) + " cannot be read");
    file->SetFileName(arguments[0]);
    file->ReadImageInformation();
    switch (file->GetComponentType()) {
    case itk::IOComponentEnum::SHORT: return trace<short>(arguments);
    case itk::IOComponentEnum::FLOAT: return trace<float>(arguments);
    default: throw std::runtime_error("voxels must be short or float");
    }
}

} // namespace

int main(int count, char **arguments)
{
    if (count != 5) {
        std::cerr << "usage: trace VOLUME SOURCE_X,Y,Z END_X,Y,Z OUTPUT\n";
        return 2;
    }
    try {
        trace_any(arguments + 1);
    } catch (const std::exception &error) {
        std::cerr << "trace: " << error.what() << '\n';
        return 1;
    }
}
