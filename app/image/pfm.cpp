#include "app/image/image.h"

#include <bit>
#include <cstring>
#include <string>

namespace frustumscreen::image {

static_assert(std::endian::native == std::endian::little, "the PFM is written as it lies in memory");
static_assert(sizeof(glm::vec3) == 3 * sizeof(float));

Bytes encode_pfm(const ImageFloat& image) {
    const std::string header =
        "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    const std::size_t row_bytes = static_cast<std::size_t>(image.width) * sizeof(glm::vec3);
    Bytes bytes(header.size() + image.texels.size() * sizeof(glm::vec3));
    std::memcpy(bytes.data(), header.data(), header.size());
    if (image.texels.empty()) {
        return bytes;
    }
    std::byte* out = bytes.data() + header.size();
    for (int y = image.height - 1; y >= 0; --y, out += row_bytes) {
        std::memcpy(out, &image.at(0, y), row_bytes);
    }
    return bytes;
}

} // namespace frustumscreen::image
