#include "assets_baked/bake/loaders/decode_tiff.h"

#include "assets_baked/bake/loaders/picture_bytes.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bake {

namespace {

static_assert(std::endian::native == std::endian::little, "libtiff packs red into the lowest byte");

/// The bytes that libtiff reads as if they were a file.
struct Memory {
    ByteView bytes;
    std::uint64_t position = 0;
    std::string error; ///< the first one
};

Memory& memory_of(thandle_t handle) {
    return *static_cast<Memory*>(handle);
}

tmsize_t read_some(thandle_t handle, void* out, tmsize_t size) {
    Memory& memory = memory_of(handle);
    const std::uint64_t left =
        memory.bytes.size() - std::min<std::uint64_t>(memory.position, memory.bytes.size());
    const auto count =
        static_cast<std::size_t>(std::min(left, static_cast<std::uint64_t>(std::max<tmsize_t>(size, 0))));
    if (count > 0) {
        std::memcpy(out, memory.bytes.data() + memory.position, count);
    }
    memory.position += count;
    return static_cast<tmsize_t>(count);
}

tmsize_t write_nothing(thandle_t /*handle*/, void* /*data*/, tmsize_t /*size*/) {
    return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
    Memory& memory = memory_of(handle);
    const std::uint64_t from = whence == SEEK_CUR   ? memory.position
                               : whence == SEEK_END ? memory.bytes.size()
                                                    : 0;
    memory.position = from + offset; // unsigned: a step back wraps around correctly
    return memory.position;
}

int close_nothing(thandle_t /*handle*/) {
    return 0;
}

toff_t size_of_memory(thandle_t handle) {
    return memory_of(handle).bytes.size();
}

int keep_error(TIFF* /*tiff*/, void* user, const char* /*module*/, const char* format, va_list arguments) {
    auto& memory = *static_cast<Memory*>(user);
    if (memory.error.empty()) {
        std::array<char, 300> text{};
        (void)std::vsnprintf(text.data(), text.size(), format, arguments);
        memory.error = printable(text.data(), 200);
    }
    return 1;
}

int ignore_warning(TIFF* /*tiff*/, void* /*user*/, const char* /*module*/, const char* /*format*/,
                   va_list /*arguments*/) {
    return 1;
}

struct OptionsFree {
    void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};
struct TiffClose {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, TiffClose>;

/// `memory` must outlive the result.
Tiff open_tiff(Memory& memory, std::int64_t limit_texels) {
    constexpr std::int64_t bytes_a_texel = 16; // up to four channels of 32 bits
    constexpr std::int64_t spare = 1 << 20;
    const std::unique_ptr<TIFFOpenOptions, OptionsFree> options(TIFFOpenOptionsAlloc());
    if (!options) {
        return nullptr;
    }
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), limit_texels * bytes_a_texel + spare);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, &memory);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, nullptr);
    return Tiff(TIFFClientOpenExt("", "rm", &memory, read_some, write_nothing, seek, close_nothing,
                                  size_of_memory, nullptr, nullptr, options.get()));
}

/// Tells libtiff not to multiply alpha into the colours; returns true if the file already has.
bool keep_alpha_apart(TIFF* tiff) {
    std::uint16_t count = 0;
    const std::uint16_t* kinds = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds) != 1 || count == 0) {
        return false;
    }
    std::vector<std::uint16_t> kept(kinds, kinds + count);
    const bool multiplied = kept[0] == EXTRASAMPLE_ASSOCALPHA;
    if (kept[0] == EXTRASAMPLE_UNASSALPHA) {
        kept[0] = EXTRASAMPLE_ASSOCALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, int{count}, kept.data());
    }
    return multiplied;
}

void take_alpha_out(std::span<glm::u8vec4> texels) {
    for (glm::u8vec4& texel : texels) {
        for (int k = 0; k < 3 && texel.a > 0; ++k) {
            texel[k] = static_cast<std::uint8_t>(std::min(255, (texel[k] * 255 + texel.a / 2) / texel.a));
        }
    }
}

/// The rows that are unpacked at once: whole tiles or strips, and all rows of a picture whose first row is not at the
/// top.
std::uint32_t band_rows(TIFF* tiff, std::uint32_t height) {
    constexpr std::uint32_t few = 64;
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
    if (orientation != ORIENTATION_TOPLEFT) {
        return height;
    }
    std::uint32_t rows = 0;
    TIFFGetFieldDefaulted(tiff, TIFFIsTiled(tiff) != 0 ? TIFFTAG_TILELENGTH : TIFFTAG_ROWSPERSTRIP, &rows);
    rows = std::clamp(rows, 1U, height);
    return std::min(height, rows * std::max(1U, few / rows));
}

/// A kind that libtiff 4.5 unpacks wrongly; empty: none. Its readers of grey texels pass over too few bytes at the end of a
/// tile that the picture's edge cuts, and leave out an alpha of 16 bits.
std::string wrongly_unpacked(TIFF* tiff, std::uint32_t width) {
    std::uint16_t meaning = PHOTOMETRIC_RGB;
    std::uint16_t bits = 1;
    std::uint16_t channels = 1;
    std::uint16_t extra = 0;
    const std::uint16_t* kinds = nullptr;
    std::uint32_t tile = 0;
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &meaning);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &channels);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extra, &kinds);
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &tile);
    if (meaning != PHOTOMETRIC_MINISBLACK && meaning != PHOTOMETRIC_MINISWHITE) {
        return {};
    }
    if (bits == 16 && extra > 0 && kinds[0] != EXTRASAMPLE_UNSPECIFIED) {
        return "grey of 16 bits with alpha";
    }
    return tile > 0 && width % tile != 0 && bits * channels > 8 ? "grey of more than 8 bits in tiles" : "";
}

/// libtiff's reader of RGBA texels, from the top.
class Texels {
public:
    explicit Texels(TIFF* tiff) {
        if (TIFFRGBAImageOK(tiff, reason_.data()) == 1 &&
            TIFFRGBAImageBegin(&rgba_, tiff, 1, reason_.data()) == 1) {
            has_begun_ = true;
            rgba_.req_orientation = ORIENTATION_TOPLEFT;
        }
    }
    Texels(const Texels&) = delete;
    Texels& operator=(const Texels&) = delete;
    ~Texels() {
        if (has_begun_) {
            TIFFRGBAImageEnd(&rgba_);
        }
    }
    [[nodiscard]] bool has_begun() const { return has_begun_; }
    [[nodiscard]] const char* reason() const { return reason_.data(); }

    /// Fills whole rows from row `first` on, which begins a strip or a row of tiles.
    [[nodiscard]] bool read(std::uint32_t first, std::span<glm::u8vec4> rows) {
        rgba_.row_offset = static_cast<int>(first);
        return TIFFRGBAImageGet(&rgba_, reinterpret_cast<std::uint32_t*>(rows.data()), rgba_.width,
                                static_cast<std::uint32_t>(rows.size() / rgba_.width)) == 1;
    }

private:
    std::array<char, 1024> reason_{}; // the length that libtiff requires
    TIFFRGBAImage rgba_{};
    bool has_begun_ = false;
};

} // namespace

bool is_tiff(ByteView bytes) {
    const std::string_view text = as_text(bytes.subspan(0, std::min<std::size_t>(bytes.size(), 4)));
    using namespace std::string_view_literals;
    return text == "II\x2a\0"sv || text == "MM\0\x2a"sv || text == "II\x2b\0"sv || text == "MM\0\x2b"sv;
}

Result<ShrunkImage> decode_tiff(ByteView bytes, const Halvings& halvings, std::int64_t limit_texels) {
    Memory memory{bytes, 0, {}};
    const auto damaged = [&] {
        return bad_input("picture.tiff_damaged",
                         "the TIFF picture is damaged, or of a kind that cannot be read ({}); save it as "
                         "PNG",
                         memory.error.empty() ? "no reason is known" : memory.error);
    };
    const Tiff tiff = open_tiff(memory, limit_texels);
    if (!tiff) {
        return damaged();
    }
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
    const std::uint32_t band = band_rows(tiff.get(), std::max(height, 1U));
    if (width < 1 || height < 1 || std::int64_t{width} * band > limit_texels) {
        return too_large(width, height, limit_texels);
    }
    if (memory.error = wrongly_unpacked(tiff.get(), width); !memory.error.empty()) {
        return damaged();
    }
    const bool multiplied = keep_alpha_apart(tiff.get());
    Texels texels(tiff.get());
    if (!texels.has_begun()) {
        memory.error = printable(texels.reason(), 200);
        return damaged();
    }
    const auto read = [&](std::uint32_t first, std::span<glm::u8vec4> rows) {
        const bool is_sound = texels.read(first, rows) && memory.error.empty();
        if (multiplied) {
            take_alpha_out(rows);
        }
        return is_sound;
    };
    const glm::ivec2 size(width, height);
    image::Image8 rows(size.x, static_cast<int>(band));
    if (band == height) {
        return read(0, rows.texels) ? Result<ShrunkImage>({halved(std::move(rows), halvings(size)), size})
                                    : damaged();
    }
    TRY(image::RowShrinker shrinker, row_shrinker(width, height, halvings, limit_texels));
    for (std::uint32_t first = 0; first < height; first += band) {
        const std::size_t count = std::min(band, height - first);
        if (!read(first, std::span(rows.texels).first(count * width))) {
            return damaged();
        }
        for (std::size_t row = 0; row < count; ++row) {
            shrinker.add(std::span(rows.texels).subspan(row * width, width));
        }
    }
    return ShrunkImage{shrinker.take(), size};
}

} // namespace frustumscreen::bake
