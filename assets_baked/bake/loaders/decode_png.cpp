#include "assets_baked/bake/loaders/decode_png.h"

#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

namespace frustumscreen::bake {

namespace {

/// The chunks that make texels: colour profiles must be ignored, and text need not be unpacked.
std::vector<ByteView> essential_chunks(ByteView png) {
    constexpr std::array kept = {std::string_view("IHDR"), std::string_view("PLTE"), std::string_view("tRNS"),
                                 std::string_view("IDAT"), std::string_view("IEND")};
    constexpr std::size_t signature = 8;
    constexpr std::size_t frame = 12; // length, type, checksum
    std::vector<ByteView> essential{png.first(signature)};
    std::size_t position = signature;
    while (png.size() - position >= frame) {
        const std::size_t room = png.size() - position - frame;
        const std::size_t length = load<std::uint32_t>(png, position, std::endian::big);
        const ByteView chunk = png.subspan(position, frame + std::min(length, room));
        if (std::find(kept.begin(), kept.end(), as_text(chunk.subspan(4, 4))) != kept.end()) {
            essential.push_back(chunk);
        }
        position += chunk.size();
    }
    return essential;
}

/// libpng, reading from memory. Its errors are long jumps, so only its own functions run inside `safely`.
class PngReader {
public:
    explicit PngReader(std::vector<ByteView> chunks)
        : chunks_(std::move(chunks)),
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, keep_error, keep_warning)) {
        if (png_ != nullptr) {
            info_ = png_create_info_struct(png_);
            png_set_read_fn(png_, this, read_some);
        }
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    [[nodiscard]] png_structp png() const { return png_; }
    [[nodiscard]] png_infop info() const { return info_; }
    [[nodiscard]] std::string message() const { return printable(message_.data(), 200); }

    /// Calls functions of libpng; returns false after an error or a warning, which indicates damage.
    template <typename Call> [[nodiscard]] bool safely(const Call& call) {
        if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) {
            return false;
        }
        call();
        return message_[0] == '\0';
    }

private:
    static void keep_warning(png_structp png, png_const_charp text) {
        std::array<char, 200>& message = static_cast<PngReader*>(png_get_error_ptr(png))->message_;
        if (message[0] == '\0') {
            (void)std::snprintf(message.data(), message.size(), "%s", text);
        }
    }
    [[noreturn]] static void keep_error(png_structp png, png_const_charp text) {
        keep_warning(png, text);
        png_longjmp(png, 1);
    }
    static void read_some(png_structp png, png_bytep out, std::size_t size) {
        auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
        while (size > 0) {
            if (reader.chunk_ == reader.chunks_.size()) {
                png_error(png, "it ends too early");
            }
            const ByteView left = reader.chunks_[reader.chunk_].subspan(reader.position_);
            const std::size_t count = std::min(size, left.size());
            std::memcpy(out, left.data(), count);
            out += count;
            size -= count;
            reader.position_ += count;
            if (count == left.size()) {
                ++reader.chunk_;
                reader.position_ = 0;
            }
        }
    }

    std::vector<ByteView> chunks_;
    std::size_t chunk_ = 0;    ///< the one that is read
    std::size_t position_ = 0; ///< in it
    std::array<char, 200> message_{};
    png_structp png_;
    png_infop info_ = nullptr;
};

/// Reads the header, and asks for rows of four 8-bit channels.
bool begin(PngReader& reader) {
    constexpr std::size_t texel_bytes = 4;
    std::size_t row_bytes = 0;
    const bool has_begun = reader.safely([&] {
        png_structp png = reader.png();
        png_read_info(png, reader.info());
        png_set_expand(png); // palettes, and transparent colours
        png_set_scale_16(png);
        png_set_gray_to_rgb(png);
        png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
        (void)png_set_interlace_handling(png);
        png_read_update_info(png, reader.info());
        row_bytes = png_get_rowbytes(png, reader.info());
    });
    return has_begun && row_bytes == texel_bytes * png_get_image_width(reader.png(), reader.info());
}

bool read_row(PngReader& reader, glm::u8vec4* row) {
    return reader.safely([&] { png_read_row(reader.png(), reinterpret_cast<png_bytep>(row), nullptr); });
}

/// Each pass fills in more texels of the rows.
bool read_passes(PngReader& reader, image::Image8& picture) {
    for (int pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES; ++pass) {
        for (int y = 0; y < picture.height; ++y) {
            if (!read_row(reader, &picture.at(0, y))) {
                return false;
            }
        }
    }
    return true;
}

bool read_rows(PngReader& reader, const glm::ivec2& size, image::RowShrinker& shrinker) {
    std::vector<glm::u8vec4> row(static_cast<std::size_t>(size.x));
    for (int y = 0; y < size.y; ++y) {
        if (!read_row(reader, row.data())) {
            return false;
        }
        shrinker.add(row);
    }
    return true;
}

} // namespace

bool is_png(ByteView bytes) {
    return as_text(bytes).starts_with("\x89PNG\r\n");
}

Result<ShrunkImage> decode_png(ByteView bytes, const Halvings& halvings, std::int64_t limit_texels) {
    if (bytes.size() < 8) {
        return bad_input("picture.png_truncated", "the PNG picture is truncated");
    }
    PngReader reader(essential_chunks(bytes));
    if (!begin(reader)) {
        return bad_input("picture.png_damaged", "the PNG picture is damaged: {}", reader.message());
    }
    const glm::i64vec2 size(png_get_image_width(reader.png(), reader.info()),
                            png_get_image_height(reader.png(), reader.info()));
    ShrunkImage read{{}, size};
    bool is_whole = false;
    if (png_get_interlace_type(reader.png(), reader.info()) != PNG_INTERLACE_NONE) {
        TRY(image::Image8 picture, blank_image(size.x, size.y, limit_texels));
        is_whole = read_passes(reader, picture);
        read.image = halved(std::move(picture), halvings(size));
    } else {
        TRY(image::RowShrinker shrinker, row_shrinker(size.x, size.y, halvings, limit_texels));
        is_whole = read_rows(reader, size, shrinker);
        read.image = shrinker.take();
    }
    if (!is_whole) {
        return bad_input("picture.png_rows_damaged", "the PNG picture is damaged: {}", reader.message());
    }
    return read;
}

} // namespace frustumscreen::bake
