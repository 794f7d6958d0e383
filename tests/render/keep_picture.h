/// Keeps a test's picture for a person to look at.
///
/// Threads  any.
#pragma once

#include "app/image/image.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace frustumscreen::synthetic {

/// Writes name.png where an environment variable names a folder.
inline void keep_picture(const image::Image8& picture, const char* variable, const std::string& name) {
    if (const char* const folder = std::getenv(variable); folder != nullptr) {
        const Bytes bytes = image::encode_png(picture);
        std::ofstream(std::string(folder) + "/" + name + ".png", std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
}

} // namespace frustumscreen::synthetic
