#include "answer.hpp"

#include "refusal.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

using nlohmann::ordered_json;

namespace {

const char *ending_name(std::uint32_t ending)
{
    switch (ending) {
    case HP_ENDED_SOURCE:
        return "source";
    case HP_ENDED_UNREACHABLE:
        return "unreachable";
    case HP_ENDED_NOT_REACHED:
        return "not_reached";
    default:
        return "step_limit";
    }
}

ordered_json path_json(const hp_paths *paths, std::uint64_t index)
{
    hp_path_info info;
    info.struct_size = sizeof info;
    check(hp_paths_info(paths, index, &info));
    std::vector<std::array<double, 2>> points(info.point_count);
    check(hp_paths_points(paths, index, points.data()->data(), info.point_count));
    ordered_json path;
    path["points"] = points;
    path["length"] = info.length;
    path["physical_length"] = info.physical_length;
    path["ended"] = ending_name(info.ending);
    path["source"] = info.source < 0 ? ordered_json() : ordered_json(info.source);
    path["end"] = points.front();
    path["distance"] = std::isfinite(info.distance) ? ordered_json(info.distance) : ordered_json();
    path["cost"] = info.cost;
    return path;
}

} // namespace

std::string paths_json(const hp_paths *paths, const hp_buffer &image)
{
    std::uint64_t count = 0;
    check(hp_paths_count(paths, &count));
    ordered_json list = ordered_json::array();
    for (std::uint64_t index = 0; index < count; index++)
        list.push_back(path_json(paths, index));
    ordered_json document;
    document["version"] = 1;
    document["dimension"] = 2;
    document["spacing"] = {image.spacing[0], image.spacing[1]};
    document["paths"] = std::move(list);
    return document.dump() + "\n";
}

std::string npy(const std::vector<double> &values, const hp_buffer &image)
{
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                         std::to_string(image.size[1]) + ", " + std::to_string(image.size[0]) +
                         "), }";
    // Magic, version and length take 10 bytes; the numbers begin at a multiple of 64.
    header.append(63 - (10 + header.size()) % 64, ' ');
    header += '\n';
    std::string file("\x93NUMPY\x01\x00", 8);
    file += static_cast<char>(header.size() & 0xff);
    file += static_cast<char>(header.size() >> 8);
    file += header;
    file.append(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(double));
    return file;
}
