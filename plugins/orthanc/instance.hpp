// A stored instance as heatpath sees it.
#pragma once

#include <heatpath.h>
#include <orthanc/OrthancCPlugin.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

// The pixels of one frame, decoded by Orthanc; the buffer describes Orthanc's own memory.
class Instance {
  public:
    // channel: red, green or blue, for colour images.
    Instance(OrthancPluginContext *context, const std::string &id, std::uint32_t frame,
             const std::optional<std::string> &channel);

    const hp_buffer &buffer() const { return pixels; }

  private:
    struct Free {
        OrthancPluginContext *context;
        void operator()(OrthancPluginImage *image) const
        {
            OrthancPluginFreeImage(context, image);
        }
    };

    std::unique_ptr<OrthancPluginImage, Free> image;
    hp_buffer pixels;
};
