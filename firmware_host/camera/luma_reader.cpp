#include "firmware_host/camera/luma_reader.h"

#include <turbojpeg.h>

#include <algorithm>

namespace frustumscreen::camera {

struct LumaReader::Jpeg {
    struct Destroy {
        void operator()(void* handle) const { ::tjDestroy(handle); }
    };
    std::unique_ptr<void, Destroy> handle{::tjInitDecompress()};
};

LumaReader::LumaReader() : jpeg_(std::make_unique<Jpeg>()) {}
LumaReader::~LumaReader() = default;
LumaReader::LumaReader(LumaReader&&) noexcept = default;
LumaReader& LumaReader::operator=(LumaReader&&) noexcept = default;

namespace {

bool read_jpeg(void* handle, const FrameFormat& format, std::span<const std::byte> bytes,
               std::vector<std::uint8_t>& luma) {
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colours = 0;
    if (handle == nullptr || bytes.empty() ||
        ::tjDecompressHeader3(handle, data, bytes.size(), &width, &height, &subsampling, &colours) != 0 ||
        width != format.width || height != format.height) {
        return false;
    }
    // After a warning of libjpeg (a truncated frame, invalid bits) a part of the picture would be invented.
    return ::tjDecompress2(handle, data, bytes.size(), luma.data(), width, width, height, TJPF_GRAY,
                           TJFLAG_FASTDCT | TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING) == 0;
}

} // namespace

bool LumaReader::read(const FrameFormat& format, std::span<const std::byte> bytes,
                      std::vector<std::uint8_t>& luma) {
    const auto width = static_cast<std::size_t>(format.width);
    const auto height = static_cast<std::size_t>(format.height);
    luma.resize(width * height);
    if (format.format == PixelFormat::Mjpeg) {
        return read_jpeg(jpeg_->handle.get(), format, bytes, luma);
    }
    const std::size_t bytes_each = format.format == PixelFormat::Yuyv ? 2 : 1;
    const std::size_t needed = bytes_each * width;
    const std::size_t row_bytes = std::max(format.row_bytes, needed);
    if (height == 0 || bytes.size() < (height - 1) * row_bytes + needed) {
        return false;
    }
    for (std::size_t y = 0; y < height; ++y) {
        const auto* const from = reinterpret_cast<const std::uint8_t*>(bytes.data()) + y * row_bytes;
        std::uint8_t* const to = luma.data() + y * width;
        for (std::size_t x = 0; x < width; ++x) {
            to[x] = from[bytes_each * x];
        }
    }
    return true;
}

} // namespace frustumscreen::camera
