// HP_EIKONAL beside ITK's FastMarchingImageFilter, where the answer is known.
//
//     fast_marching
//
// The speed F of a front grows along a slope: F = 1 + g . (x - source), with the physical point x. It
// then arrives at the time T = acosh(1 + |g|^2 |x - source|^2 / (2 F)) / |g|. Prints, over all voxels
// of a rotated volume with voxels that are no cubes, "NAME mean MEAN largest LARGEST": the true
// distance, the errors of both, and their difference.
#include <itkFastMarchingImageFilter.h>
#include <itkImage.h>
#include <itkImageRegionIteratorWithIndex.h>

#include <heatpath.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace {

using Image = itk::Image<float, 3>;
using Distances = itk::Image<double, 3>;

constexpr Image::IndexType source{{6, 9, 8}};

Image::Pointer speed_image(const Image::PointType::VectorType &slope)
{
    const auto image = Image::New();
    image->SetRegions(Image::SizeType{{48, 40, 30}});
    image->SetSpacing(Image::SpacingType(std::array<double, 3>{0.7, 0.9, 1.3}.data()));
    image->SetOrigin(Image::PointType(std::array<double, 3>{-12, 30.5, 7}.data()));
    Image::DirectionType turned;
    turned.SetIdentity();
    turned(0, 0) = turned(1, 1) = std::cos(0.4);
    turned(1, 0) = std::sin(0.4);
    turned(0, 1) = -std::sin(0.4);
    image->SetDirection(turned);
    image->Allocate();
    Image::PointType start, place;
    image->TransformIndexToPhysicalPoint(source, start);
    for (itk::ImageRegionIteratorWithIndex<Image> it(image, image->GetBufferedRegion());
         !it.IsAtEnd(); ++it) {
        image->TransformIndexToPhysicalPoint(it.GetIndex(), place);
        it.Set(static_cast<float>(1 + slope * (place - start)));
    }
    return image;
}

Distances::Pointer like(const Image *image)
{
    const auto result = Distances::New();
    result->CopyInformation(image);
    result->SetRegions(image->GetBufferedRegion());
    result->Allocate(true);
    return result;
}

Distances::Pointer exact(const Image *speed, const Image::PointType::VectorType &slope)
{
    const auto result = like(speed);
    Image::PointType start, place;
    speed->TransformIndexToPhysicalPoint(source, start);
    for (itk::ImageRegionIteratorWithIndex<Distances> it(result, result->GetBufferedRegion());
         !it.IsAtEnd(); ++it) {
        speed->TransformIndexToPhysicalPoint(it.GetIndex(), place);
        const double steep = slope.GetNorm(), way = steep * (place - start).GetNorm();
        it.Set(std::acosh(1 + way * way / (2 * speed->GetPixel(it.GetIndex()))) / steep);
    }
    return result;
}

Distances::Pointer by_itk(const Image *speed)
{
    using Filter = itk::FastMarchingImageFilter<Distances, Image>;
    const auto filter = Filter::New();
    const auto seeds = Filter::NodeContainer::New();
    Filter::NodeType seed;
    seed.SetIndex(source);
    seed.SetValue(0);
    seeds->InsertElement(0, seed);
    filter->SetTrialPoints(seeds);
    filter->SetInput(speed);
    filter->Update();
    return filter->GetOutput();
}

// The medium is the square of the speed.
Distances::Pointer by_heatpath(const Image *speed)
{
    const auto squared = like(speed);
    itk::ImageRegionIteratorWithIndex<Distances> to(squared, squared->GetBufferedRegion());
    for (; !to.IsAtEnd(); ++to)
        to.Set(std::pow(static_cast<double>(speed->GetPixel(to.GetIndex())), 2));
    heatpath::Options options;
    options.medium = HP_MEDIUM_GIVEN;
    options.estimator = HP_EIKONAL;
    const heatpath::Buffer image = heatpath::buffer(squared.GetPointer());
    const heatpath::Points<3> sources{{double(source[0]), double(source[1]), double(source[2])}};
    heatpath::distance(image, sources, image, options); // the result takes the place of the medium
    return squared;
}

void compare(const char *name, const Distances *one, const Distances *other)
{
    double sum = 0, largest = 0;
    const auto region = one->GetBufferedRegion();
    for (itk::ImageRegionConstIteratorWithIndex<Distances> it(one, region); !it.IsAtEnd(); ++it) {
        const double difference = std::abs(it.Get() - other->GetPixel(it.GetIndex()));
        sum += difference;
        largest = std::max(largest, difference);
    }
    std::printf("%s mean %.6f largest %.6f\n", name, sum / region.GetNumberOfPixels(), largest);
}

} // namespace

int main()
{
    try {
        const Image::PointType::VectorType slope(std::array<double, 3>{0.01, 0.006, -0.004}.data());
        const auto speed = speed_image(slope);
        const auto truth = exact(speed, slope), itk = by_itk(speed), heatpath = by_heatpath(speed);
        compare("distance", truth, like(speed));
        compare("itk", itk, truth);
        compare("heatpath", heatpath, truth);
        compare("difference", heatpath, itk);
    } catch (const std::exception &error) {
        std::cerr << "fast_marching: " << error.what() << '\n';
        return 1;
    }
}
