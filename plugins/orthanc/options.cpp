#include "options.hpp"

#include "refusal.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace {

using Names = std::initializer_list<std::pair<const char *, std::uint32_t>>;

void read_choice(Request &request, const char *name, const Names &names, std::uint32_t &choice)
{
    const auto wanted = request.text(name);
    if (!wanted)
        return;
    std::string known;
    for (const auto &[own, number] : names) {
        if (*wanted == own) {
            choice = number;
            return;
        }
        known += (known.empty() ? "" : ", ") + std::string(own);
    }
    throw Refusal(400, std::string("`") + name + "` must be one of: " + known);
}

void read_choices(Request &request, hp_options &options)
{
    read_choice(request, "medium",
                {{"uniform", HP_MEDIUM_UNIFORM},
                 {"conductivity", HP_MEDIUM_CONDUCTIVITY},
                 {"perona-malik", HP_MEDIUM_PERONA_MALIK},
                 {"combined", HP_MEDIUM_COMBINED},
                 {"edges", HP_MEDIUM_EDGES},
                 {"tensor", HP_MEDIUM_TENSOR},
                 {"vesselness", HP_MEDIUM_VESSELNESS}},
                options.medium);
    read_choice(request, "edge_stop",
                {{"exponential", HP_EDGE_STOP_EXPONENTIAL}, {"rational", HP_EDGE_STOP_RATIONAL}},
                options.edge_stop);
    read_choice(request, "tensor",
                {{"hessian", HP_DIRECTIONS_HESSIAN},
                 {"structure", HP_DIRECTIONS_STRUCTURE},
                 {"gradient", HP_DIRECTIONS_GRADIENT}},
                options.directions);
    read_choice(request, "polarity",
                {{"bright", HP_POLARITY_BRIGHT},
                 {"dark", HP_POLARITY_DARK},
                 {"both", HP_POLARITY_BOTH}},
                options.polarity);
    read_choice(request, "form",
                {{"divergence", HP_FORM_DIVERGENCE}, {"pointwise", HP_FORM_POINTWISE}},
                options.form);
    read_choice(request, "solver",
                {{"explicit", HP_SOLVER_EXPLICIT}, {"implicit", HP_SOLVER_IMPLICIT}},
                options.solver);
    read_choice(request, "estimator",
                {{"normalized", HP_NORMALIZED},
                 {"varadhan", HP_VARADHAN},
                 {"heat-method", HP_HEAT_METHOD},
                 {"eikonal", HP_EIKONAL}},
                options.estimator);
}

void read_numbers(Request &request, hp_options &options)
{
    const std::pair<const char *, double hp_options::*> numbers[] = {
        {"power", &hp_options::power},         {"floor", &hp_options::floor},
        {"contrast", &hp_options::contrast},   {"smooth", &hp_options::smoothing},
        {"reference", &hp_options::reference}, {"time", &hp_options::time},
        {"farthest", &hp_options::farthest},   {"anisotropy", &hp_options::anisotropy},
        {"elongation", &hp_options::elongation}, {"normalize", &hp_options::normalize},
        {"margin", &hp_options::margin},
    };
    for (const auto &[name, member] : numbers)
        options.*member = request.number(name).value_or(options.*member);
    options.step = request.step("step").value_or(options.step);
    options.iterations = request.count("iterations").value_or(options.iterations);
    if (const auto range = request.pair("range")) {
        options.range_low = (*range)[0];
        options.range_high = (*range)[1];
    }
}

} // namespace

hp_options read_options(Request &request, std::vector<double> &scales)
{
    hp_options options;
    check(hp_options_init(&options, sizeof options));
    read_choices(request, options);
    read_numbers(request, options);
    scales = request.numbers("scale");
    options.scales = scales.data();
    options.scale_count = scales.size();
    const auto threads = request.count("threads").value_or(options.threads);
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    options.threads = static_cast<std::uint32_t>(std::min(threads, most));
    return options;
}
