// A camera's frame: one byte for its format, two for its size, one for the length of its rows; the rest is
// the received data. An accepted frame is whole, and each of its pixels was written.
#include "firmware_host/camera/luma_reader.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace frustumscreen;

bool read(const camera::FrameFormat& format, std::span<const std::byte> bytes, std::uint8_t before,
          std::vector<std::uint8_t>& luma) {
    static camera::LumaReader reader; // shared by all frames, as in a camera
    luma.assign(static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height), before);
    return reader.read(format, bytes, luma);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t head = 4;
    if (size < head) {
        return 0;
    }
    const camera::FrameFormat format{static_cast<camera::PixelFormat>(data[0] % 3), data[1] + 1, data[2] + 1,
                                     data[3] * 4U};
    // A copy of exactly this length: reads beyond it are detected.
    const std::vector<std::uint8_t> exact(data + head, data + size);
    const auto bytes = std::as_bytes(std::span(exact));
    std::vector<std::uint8_t> luma;
    std::vector<std::uint8_t> again;
    if (read(format, bytes, 0x00, luma)) {
        fuzz::require(luma.size() ==
                          static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height),
                      "a frame has its size");
        fuzz::require(read(format, bytes, 0xFF, again) && luma == again, "each pixel was written");
    }
    return 0;
}
