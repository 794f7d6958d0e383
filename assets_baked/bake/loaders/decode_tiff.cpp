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

void take_alpha_out(image::Image8& picture) {
    for (glm::u8vec4& texel : picture.texels) {
        for (int k = 0; k < 3 && texel.a > 0; ++k) {
            texel[k] = static_cast<std::uint8_t>(std::min(255, (texel[k] * 255 + texel.a / 2) / texel.a));
        }
    }
}

} // namespace

bool is_tiff(ByteView bytes) {
    const std::string_view text = as_text(bytes.subspan(0, std::min<std::size_t>(bytes.size(), 4)));
    using namespace std::string_view_literals;
    return text == "II\x2a\0"sv || text == "MM\0\x2a"sv || text == "II\x2b\0"sv || text == "MM\0\x2b"sv;
}

Result<image::Image8> decode_tiff(ByteView bytes, std::int64_t limit_texels) {
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
    TRY(image::Image8 picture, blank_image(width, height, limit_texels));
    const bool multiplied = keep_alpha_apart(tiff.get());
    std::array<char, 1024> reason{}; // the length that libtiff requires
    if (TIFFRGBAImageOK(tiff.get(), reason.data()) != 1) {
        memory.error = printable(reason.data(), 200);
        return damaged();
    }
    auto* const texels = reinterpret_cast<std::uint32_t*>(picture.texels.data());
    if (TIFFReadRGBAImageOriented(tiff.get(), width, height, texels, ORIENTATION_TOPLEFT, 1) != 1 ||
        !memory.error.empty()) {
        return damaged();
    }
    if (multiplied) {
        take_alpha_out(picture);
    }
    return picture;
}

} // namespace frustumscreen::bake
