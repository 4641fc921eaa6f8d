// Why a request gets no answer.
#pragma once

#include <heatpath.h>

#include <cstdint>
#include <stdexcept>
#include <string>

// An HTTP status and one line for whoever asked.
struct Refusal : std::runtime_error {
    Refusal(std::uint16_t http_status, const std::string &line)
        : std::runtime_error(line), status(http_status)
    {
    }

    std::uint16_t status;
};

// Throws unless a call of heatpath succeeded.
void check(hp_status status);
