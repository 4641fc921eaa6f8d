// Results as they go over the network.
#pragma once

#include <heatpath.h>

#include <string>
#include <vector>

// Paths as the command writes them to JSON.
std::string paths_json(const hp_paths *paths, const hp_buffer &image);

// Numbers of pixels, row by row, as an array of numpy.
std::string npy(const std::vector<double> &values, const hp_buffer &image);
