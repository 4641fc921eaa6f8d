#include "request.hpp"

#include "refusal.hpp"

#include <algorithm>

using nlohmann::json;

namespace {

[[noreturn]] void wrong(const char *name, const char *expected)
{
    throw Refusal(400, std::string("`") + name + "` must be " + expected);
}

bool is_pair(const json &value)
{
    return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

} // namespace

Request::Request(std::string_view body)
    : object(json::parse(body, nullptr, /* allow_exceptions */ false))
{
    if (!object.is_object())
        throw Refusal(400, "the body must be a JSON object");
}

const json *Request::find(const char *name)
{
    known.insert(name);
    const auto field = object.find(name);
    return field == object.end() ? nullptr : &*field;
}

std::optional<double> Request::number(const char *name)
{
    const json *value = find(name);
    if (!value)
        return std::nullopt;
    if (!value->is_number())
        wrong(name, "a number");
    return value->get<double>();
}

std::optional<std::uint64_t> Request::count(const char *name)
{
    const json *value = find(name);
    if (!value)
        return std::nullopt;
    if (!value->is_number_unsigned())
        wrong(name, "an integer from 0 on");
    return value->get<std::uint64_t>();
}

std::optional<std::string> Request::text(const char *name)
{
    const json *value = find(name);
    if (!value)
        return std::nullopt;
    if (!value->is_string())
        wrong(name, "a text");
    return value->get<std::string>();
}

std::optional<std::array<double, 2>> Request::pair(const char *name)
{
    const json *value = find(name);
    if (!value)
        return std::nullopt;
    if (!is_pair(*value))
        wrong(name, "two numbers");
    return value->get<std::array<double, 2>>();
}

std::vector<double> Request::numbers(const char *name)
{
    const json *value = find(name);
    if (!value)
        return {};
    if (value->is_number())
        return {value->get<double>()};
    const auto is_number = [](const json &entry) { return entry.is_number(); };
    if (!value->is_array() || !std::all_of(value->begin(), value->end(), is_number))
        wrong(name, "a number or a list of numbers");
    return value->get<std::vector<double>>();
}

std::vector<double> Request::points(const char *name)
{
    const json *value = find(name);
    if (!value)
        throw Refusal(400, std::string("`") + name + "` is missing");
    if (is_pair(*value))
        return value->get<std::vector<double>>();
    if (!value->is_array())
        wrong(name, "[x, y] or [[x, y], ...]");
    std::vector<double> coordinates;
    for (const json &point : *value) {
        if (!is_pair(point))
            wrong(name, "[x, y] or [[x, y], ...]");
        coordinates.insert(coordinates.end(), {point[0].get<double>(), point[1].get<double>()});
    }
    return coordinates;
}

std::optional<double> Request::step(const char *name)
{
    const json *value = find(name);
    if (!value)
        return std::nullopt;
    if (*value == "auto")
        return 0.0;
    if (!value->is_number())
        wrong(name, "a number or \"auto\"");
    return value->get<double>();
}

void Request::refuse_others() const
{
    for (const auto &[name, value] : object.items()) {
        if (known.count(name) == 0)
            throw Refusal(400, "there is no option `" + name + "` here");
    }
}
