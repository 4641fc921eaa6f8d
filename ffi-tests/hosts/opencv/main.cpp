// The minimal path between two pixels in a part of a picture, with OpenCV.
//
//     trace PICTURE CHANNEL X,Y,WIDTH,HEIGHT SOURCE_X,SOURCE_Y END_X,END_Y OUTPUT
//
// Looks at one channel (0 is blue, as OpenCV counts) of a rectangle of the picture, of any depth that
// heatpath knows. Points are pixels of the rectangle. Writes OUTPUT.png, the rectangle with the path
// on it, and OUTPUT.raw, the distance of each of its pixels from the source as doubles; prints the
// points of the path.
//
// heatpath reads the pixels, and writes the distances, where they are in the memory of a cv::Mat.
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <heatpath.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Point = heatpath::Point<2>;
using Points = heatpath::Points<2>;

// The picture in 8 bits a channel and three channels, with the path in red.
cv::Mat draw(const cv::Mat &pixels, const Points &path)
{
    cv::Mat grey, picture;
    cv::normalize(pixels, grey, 0, 255, cv::NORM_MINMAX, CV_8U);
    if (grey.channels() == 1)
        cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
    else if (grey.channels() == 4)
        cv::cvtColor(grey, picture, cv::COLOR_BGRA2BGR);
    else
        picture = grey;
    // OpenCV takes integers; with a shift of 4 they are sixteenths of a pixel.
    std::vector<cv::Point> sixteenths;
    for (const Point &point : path)
        sixteenths.emplace_back(cvRound(16 * point[0]), cvRound(16 * point[1]));
    cv::polylines(picture, sixteenths, false, cv::Scalar(0, 0, 255), 1, cv::LINE_8, 4);
    return picture;
}

std::vector<double> numbers(const std::string &text, size_t count)
{
    std::vector<double> result;
    std::istringstream stream(text);
    for (std::string number; std::getline(stream, number, ',');)
        result.push_back(std::stod(number));
    if (result.size() != count)
        throw std::runtime_error(text + " should be " + std::to_string(count) + " numbers");
    return result;
}

Point point(const std::string &text)
{
    const std::vector<double> xy = numbers(text, 2);
    return {xy[0], xy[1]};
}

void trace(char **arguments)
{
    const cv::Mat picture = cv::imread(arguments[0], cv::IMREAD_UNCHANGED);
    if (picture.empty())
        throw std::runtime_error(std::string(arguments[0]) + " cannot be read");
    const std::vector<double> at = numbers(arguments[2], 4);
    const cv::Mat part = picture(cv::Rect(at[0], at[1], at[2], at[3]));
    const heatpath::Buffer image = heatpath::buffer(part, std::stoi(arguments[1]));
    const Points sources{point(arguments[3])}, ends{point(arguments[4])};

    // From the end to the source; without the source if there is no way to it.
    const heatpath::Path<2> path = heatpath::paths<2>(image, sources, ends)[0];
    for (const Point &point : path.points)
        std::printf("%.17g,%.17g\n", point[0], point[1]);
    const std::string output = arguments[5];
    if (!cv::imwrite(output + ".png", draw(part, path.points)))
        throw std::runtime_error(output + ".png cannot be written");
    const cv::Mat_<double> map(part.size());
    heatpath::distance(image, sources, heatpath::buffer(map));
    std::ofstream raw(output + ".raw", std::ios::binary);
    raw.exceptions(std::ios::failbit | std::ios::badbit);
    raw.write(map.ptr<char>(), static_cast<std::streamsize>(map.total() * map.elemSize()));
}

} // namespace

int main(int count, char **arguments)
{
    if (count != 7) {
        std::cerr << "usage: trace PICTURE CHANNEL X,Y,WIDTH,HEIGHT SOURCE_X,SOURCE_Y"
                     " END_X,END_Y OUTPUT\n";
        return 2;
    }
    try {
        trace(arguments + 1);
    } catch (const std::exception &error) {
        std::cerr << "trace: " << error.what() << '\n';
        return 1;
    }
}
