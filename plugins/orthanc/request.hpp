// The JSON object that a client posts.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// Gives out the fields by name; refuses those of the wrong type and those that nobody asked for.
class Request {
  public:
    explicit Request(std::string_view body);

    std::optional<double> number(const char *name);
    std::optional<std::uint64_t> count(const char *name);
    std::optional<std::string> text(const char *name);
    std::optional<std::array<double, 2>> pair(const char *name);
    // A list of numbers, or one number; empty if there is none.
    std::vector<double> numbers(const char *name);
    // x, y of each point, one after the other: from [x, y] or [[x, y], ...].
    std::vector<double> points(const char *name);
    // A time step: a number, or "auto", which is 0.
    std::optional<double> step(const char *name);

    // To be called when all fields that make sense have been asked for.
    void refuse_others() const;

  private:
    const nlohmann::json *find(const char *name);

    nlohmann::json object;
    std::set<std::string> known;
};
