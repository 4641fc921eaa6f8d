// What to compute, as the client asked for it.
#pragma once

#include "request.hpp"

#include <heatpath.h>

// The fields are called as the command's options: medium, power, edge_stop, ...
// `scales` holds what options.scales points to.
hp_options read_options(Request &request, std::vector<double> &scales);
