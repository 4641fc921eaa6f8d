#include "instance.hpp"

#include "refusal.hpp"

#include <nlohmann/json.hpp>

#include <sstream>

namespace {

// The DICOM file of an instance, in memory.
class File {
  public:
    File(OrthancPluginContext *own, const std::string &id) : context(own)
    {
        const auto found = OrthancPluginGetDicomForInstance(context, &bytes, id.c_str());
        if (found != OrthancPluginErrorCode_Success)
            throw Refusal(404, "there is no instance `" + id + "`");
    }
    ~File() { OrthancPluginFreeMemoryBuffer(context, &bytes); }
    File(const File &) = delete;
    File &operator=(const File &) = delete;

    OrthancPluginImage *decode(std::uint32_t frame) const
    {
        return OrthancPluginDecodeDicomImage(context, bytes.data, bytes.size, frame);
    }

    // The attribute of this name, if it is there and a text.
    std::optional<std::string> attribute(const char *name) const
    {
        char *text = OrthancPluginDicomBufferToJson(
            context, bytes.data, bytes.size, OrthancPluginDicomToJsonFormat_Human,
            OrthancPluginDicomToJsonFlags_StopAfterPixelData, 256);
        if (!text)
            return std::nullopt;
        const auto attributes = nlohmann::json::parse(text, nullptr, false);
        OrthancPluginFreeString(context, text);
        const auto found = attributes.find(name);
        if (found == attributes.end() || !found->is_string())
            return std::nullopt;
        return found->get<std::string>();
    }

  private:
    OrthancPluginContext *context;
    OrthancPluginMemoryBuffer bytes;
};

struct Layout {
    std::uint32_t type;
    std::uint32_t bytes_per_pixel;
    // Of a colour, where red and blue are; green lies between.
    std::optional<std::uint32_t> red, blue;
};

Layout layout(OrthancPluginPixelFormat format)
{
    switch (format) {
    case OrthancPluginPixelFormat_Grayscale8:
        return {HP_U8, 1, {}, {}};
    case OrthancPluginPixelFormat_Grayscale16:
        return {HP_U16, 2, {}, {}};
    case OrthancPluginPixelFormat_SignedGrayscale16:
        return {HP_I16, 2, {}, {}};
    case OrthancPluginPixelFormat_Grayscale32:
        return {HP_U32, 4, {}, {}};
    case OrthancPluginPixelFormat_Float32:
        return {HP_F32, 4, {}, {}};
    case OrthancPluginPixelFormat_RGB24:
        return {HP_U8, 3, 0, 2};
    case OrthancPluginPixelFormat_RGBA32:
        return {HP_U8, 4, 0, 2};
    case OrthancPluginPixelFormat_BGRA32:
        return {HP_U8, 4, 2, 0};
    case OrthancPluginPixelFormat_RGB48:
        return {HP_U16, 6, 0, 4};
    default:
        throw Refusal(422, "the pixels are of a kind that heatpath does not know");
    }
}

// Where the wanted number is in a pixel, in bytes.
std::uint32_t offset(const Layout &layout, const std::optional<std::string> &channel)
{
    if (!layout.red) {
        if (channel)
            throw Refusal(400, "`channel` is for colour images, and this one is grey");
        return 0;
    }
    if (channel == "red")
        return *layout.red;
    if (channel == "green")
        return (*layout.red + *layout.blue) / 2;
    if (channel == "blue")
        return *layout.blue;
    throw Refusal(400, "the image is coloured: `channel` must be red, green or blue");
}

// Sets the spacing by the attribute PixelSpacing, which names the distance of rows first.
void set_spacing(const File &file, hp_buffer &pixels)
{
    std::istringstream text(file.attribute("PixelSpacing").value_or(""));
    text.imbue(std::locale::classic());
    double rows = 0, columns = 0;
    char separator = 0;
    if (text >> rows >> separator >> columns && rows > 0 && columns > 0) {
        pixels.spacing[0] = columns;
        pixels.spacing[1] = rows;
    }
}

} // namespace

Instance::Instance(OrthancPluginContext *context, const std::string &id, std::uint32_t frame,
                   const std::optional<std::string> &channel)
    : image(nullptr, Free{context})
{
    const File file(context, id);
    image.reset(file.decode(frame));
    if (!image)
        throw Refusal(422, "instance `" + id + "` has no frame " + std::to_string(frame) +
                               " that Orthanc can decode");
    const Layout pixel = layout(OrthancPluginGetImagePixelFormat(context, image.get()));
    check(hp_buffer_init(&pixels, sizeof pixels));
    auto *first = static_cast<std::uint8_t *>(OrthancPluginGetImageBuffer(context, image.get()));
    pixels.data = first + offset(pixel, channel);
    pixels.type = pixel.type;
    pixels.size[0] = OrthancPluginGetImageWidth(context, image.get());
    pixels.size[1] = OrthancPluginGetImageHeight(context, image.get());
    pixels.byte_stride[0] = pixel.bytes_per_pixel;
    pixels.byte_stride[1] = OrthancPluginGetImagePitch(context, image.get());
    set_spacing(file, pixels);
}
