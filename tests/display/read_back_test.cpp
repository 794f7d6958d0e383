#include "firmware_host/display/read_back.h"
#include "tests/display/copying.h"

namespace frustumscreen::display {
namespace {

using ReadingBack = Copying;

constexpr std::byte untouched{0x5A};

TEST_F(ReadingBack, FillsMemoryInTheKernelsPixelOrder) {
    const PictureFramebuffer picture = picture_of(64, 40);
    for (const PixelSize size : {PixelSize{64, 40}, {128, 100}, {50, 30}}) {
        const std::vector<Texel> screen = copied(picture, size, TopRow::First);
        const auto width = static_cast<std::size_t>(size.width);
        const auto height = static_cast<std::size_t>(size.height);
        const std::size_t stride = 4 * width + 64; // rows are aligned as the card requires
        std::vector<std::byte> memory(stride * height, untouched);
        ASSERT_TRUE(copying_->make_current());
        {
            const Result<ReadBack> read_back = ReadBack::create(size);
            ASSERT_TRUE(read_back) << read_back.error().message;
            read_back->fill(*copy_, picture, {0, 0, 64, 40}, memory, stride);
            EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        }
        ASSERT_TRUE(drawing_->make_current());
        for (std::size_t y = 0; y < height; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                const std::byte* pixel = &memory[y * stride + 4 * x];
                const Texel& texel = screen[y * width + x];
                ASSERT_EQ(static_cast<unsigned char>(pixel[2]), texel[0]) << x << ", " << y;
                ASSERT_EQ(static_cast<unsigned char>(pixel[1]), texel[1]) << x << ", " << y;
                ASSERT_EQ(static_cast<unsigned char>(pixel[0]), texel[2]) << x << ", " << y;
            }
            EXPECT_EQ(memory[y * stride + 4 * width], untouched) << "beyond the row";
        }
    }
}

TEST_F(ReadingBack, WritesOnlyTheRequestedPart) {
    const PictureFramebuffer picture = picture_of(64, 40);
    constexpr std::size_t stride = 4 * 64;
    std::vector<std::byte> memory(stride * 40, untouched);
    ASSERT_TRUE(copying_->make_current());
    {
        const Result<ReadBack> read_back = ReadBack::create({64, 40});
        ASSERT_TRUE(read_back);
        read_back->fill(*copy_, picture, {10, 4, 20, 16}, memory, stride);
        read_back->fill(*copy_, picture, {}, memory, stride);
    }
    ASSERT_TRUE(drawing_->make_current());
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool in = x >= 10 && x < 30 && y >= 4 && y < 20;
            const std::byte red =
                memory[static_cast<std::size_t>(y) * stride + 4 * static_cast<std::size_t>(x) + 2];
            ASSERT_EQ(red, in ? std::byte{colour_of(x, y)[0]} : untouched) << x << ", " << y;
        }
    }
}

} // namespace
} // namespace frustumscreen::display
