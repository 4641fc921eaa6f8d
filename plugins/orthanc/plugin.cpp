// An Orthanc plugin: distances and paths on stored instances, over REST.
//
//     GET  /heatpath            the version
//     POST /heatpath/distance   {"instance": id, "source": [x, y], ...} -> an array of numpy
//     POST /heatpath/path       the same and "end": [x, y] -> JSON
//
// docs/orthanc.md says what else a request may hold.
#include "answer.hpp"
#include "instance.hpp"
#include "options.hpp"
#include "refusal.hpp"
#include "request.hpp"

#include <heatpath.h>
#include <orthanc/OrthancCPlugin.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

namespace {

OrthancPluginContext *context = nullptr;

// The longest that a request may compute, in seconds.
std::uint32_t time_limit = 600;

struct Body {
    std::string bytes;
    const char *type;
};

using Clock = std::chrono::steady_clock;

int is_too_late(double /* finished */, void *start)
{
    const auto spent = Clock::now() - *static_cast<Clock::time_point *>(start);
    return spent > std::chrono::seconds(time_limit);
}

// What both kinds of requests hold.
struct Task {
    explicit Task(Request &request)
        : instance(context, id(request), frame(request),
                   request.text("channel")),
          image(instance.buffer()), sources(request.points("source")),
          options(read_options(request, scales))
    {
        if (const auto spacing = request.pair("spacing"))
            std::copy(spacing->begin(), spacing->end(), image.spacing);
        if (const auto id = request.text("mask"))
            mask = std::make_unique<Instance>(context, *id, 0, std::nullopt);
        options.progress = is_too_late;
        options.user = &start;
    }

    static std::string id(Request &request)
    {
        if (const auto id = request.text("instance"))
            return *id;
        throw Refusal(400, "`instance` is missing: Orthanc's identifier of an instance");
    }

    static std::uint32_t frame(Request &request)
    {
        constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
        return static_cast<std::uint32_t>(std::min(request.count("frame").value_or(0), most));
    }

    const hp_buffer *walls() const { return mask ? &mask->buffer() : nullptr; }

    Instance instance;
    std::unique_ptr<Instance> mask;
    hp_buffer image;
    std::vector<double> sources;
    std::vector<double> scales;
    hp_options options;
    Clock::time_point start = Clock::now();
};

Body distance(Request &request)
{
    Task task(request);
    request.refuse_others();
    std::vector<double> values(task.image.size[0] * task.image.size[1]);
    hp_buffer target;
    check(hp_buffer_init(&target, sizeof target));
    target.type = HP_F64;
    target.data = values.data();
    std::copy_n(task.image.size, 2, target.size);
    check(hp_distance(&task.image, task.walls(), task.sources.data(), task.sources.size() / 2,
                      &task.options, &target));
    return {npy(values, task.image), "application/octet-stream"};
}

Body path(Request &request)
{
    Task task(request);
    const std::vector<double> ends = request.points("end");
    request.refuse_others();
    hp_paths *paths = nullptr;
    check(hp_paths_create(&task.image, task.walls(), task.sources.data(), task.sources.size() / 2,
                          ends.data(), ends.size() / 2, &task.options, &paths));
    const std::unique_ptr<hp_paths, decltype(&hp_paths_free)> owner(paths, hp_paths_free);
    return {paths_json(paths, task.image), "application/json"};
}

void answer(OrthancPluginRestOutput *output, const Body &body)
{
    if (body.bytes.size() > std::numeric_limits<std::uint32_t>::max())
        throw Refusal(413, "the answer is longer than the 4 GiB that Orthanc sends");
    OrthancPluginAnswerBuffer(context, output, body.bytes.data(),
                              static_cast<std::uint32_t>(body.bytes.size()), body.type);
}

void refuse(OrthancPluginRestOutput *output, std::uint16_t status, const std::string &line)
{
    OrthancPluginLogWarning(context, ("heatpath: " + line).c_str());
    const std::string body = line + "\n";
    OrthancPluginSetHttpHeader(context, output, "Content-Type", "text/plain; charset=utf-8");
    OrthancPluginSendHttpStatus(context, output, status, body.data(),
                                static_cast<std::uint32_t>(body.size()));
}

// No exception may leave the plugin.
template <Body (*compute)(Request &)>
OrthancPluginErrorCode post(OrthancPluginRestOutput *output, const char * /* url */,
                            const OrthancPluginHttpRequest *http)
try {
    if (http->method != OrthancPluginHttpMethod_Post) {
        OrthancPluginSendMethodNotAllowed(context, output, "POST");
        return OrthancPluginErrorCode_Success;
    }
    Request request({static_cast<const char *>(http->body), http->bodySize});
    answer(output, compute(request));
    return OrthancPluginErrorCode_Success;
} catch (const Refusal &refusal) {
    refuse(output, refusal.status, refusal.what());
    return OrthancPluginErrorCode_Success;
} catch (const std::exception &error) {
    refuse(output, 500, error.what());
    return OrthancPluginErrorCode_Success;
}

OrthancPluginErrorCode version(OrthancPluginRestOutput *output, const char * /* url */,
                               const OrthancPluginHttpRequest *http)
{
    if (http->method != OrthancPluginHttpMethod_Get) {
        OrthancPluginSendMethodNotAllowed(context, output, "GET");
    } else {
        const std::string text = std::string("{\"version\":\"") + hp_version_string() + "\"}\n";
        OrthancPluginAnswerBuffer(context, output, text.data(),
                                  static_cast<std::uint32_t>(text.size()), "application/json");
    }
    return OrthancPluginErrorCode_Success;
}

// The section "Heatpath" of Orthanc's configuration; false if it makes no sense.
bool read_configuration()
{
    constexpr std::uint64_t longest = 31'536'000; // a year
    char *text = OrthancPluginGetConfiguration(context);
    const auto all = nlohmann::json::parse(text ? text : "{}", nullptr, false);
    OrthancPluginFreeString(context, text);
    const auto own = all.is_object() ? all.value("Heatpath", nlohmann::json::object())
                                     : nlohmann::json::object();
    const auto limit =
        own.is_object() ? own.value("TimeLimit", nlohmann::json(time_limit)) : nlohmann::json();
    if (!limit.is_number_unsigned() || limit.get<std::uint64_t>() > longest) {
        OrthancPluginLogError(context, "heatpath: in the configuration, Heatpath must be "
                                       "{\"TimeLimit\": whole seconds, at most 31536000}");
        return false;
    }
    time_limit = limit.get<std::uint32_t>();
    return true;
}

} // namespace

void check(hp_status status)
{
    switch (status) {
    case HP_OK:
        return;
    case HP_CANCELLED:
        throw Refusal(503, "given up after the " + std::to_string(time_limit) +
                               " seconds of Heatpath.TimeLimit");
    case HP_INVALID_IMAGE:
    case HP_RANGE:
        throw Refusal(422, hp_last_error_message());
    case HP_OUT_OF_MEMORY:
    case HP_NO_THREADS:
        throw Refusal(503, hp_last_error_message());
    case HP_PANIC:
        throw Refusal(500, hp_last_error_message());
    default:
        throw Refusal(400, hp_last_error_message());
    }
}

extern "C" {

ORTHANC_PLUGINS_API int32_t OrthancPluginInitialize(OrthancPluginContext *own)
{
    context = own;
    if (!OrthancPluginCheckVersion(context)) {
        OrthancPluginLogError(context, "heatpath: this Orthanc is older than the plugin's SDK");
        return -1;
    }
    if (hp_abi_version() != HP_ABI_VERSION) {
        OrthancPluginLogError(context, "heatpath: libheatpath is of another version");
        return -1;
    }
    if (!read_configuration())
        return -1;
    OrthancPluginSetDescription(context, "Geodesic distances and paths on stored instances");
    // Without Orthanc's lock, because requests compute for long and share nothing.
    OrthancPluginRegisterRestCallbackNoLock(context, "/heatpath", version);
    OrthancPluginRegisterRestCallbackNoLock(context, "/heatpath/distance", post<distance>);
    OrthancPluginRegisterRestCallbackNoLock(context, "/heatpath/path", post<path>);
    return 0;
}

ORTHANC_PLUGINS_API void OrthancPluginFinalize() {}

ORTHANC_PLUGINS_API const char *OrthancPluginGetName()
{
    return "heatpath";
}

ORTHANC_PLUGINS_API const char *OrthancPluginGetVersion()
{
    return HP_VERSION_STRING;
}
}
