#include "tests/loaders/picture_forms.h"

#include <png.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

namespace frustumscreen::testing {

namespace {

constexpr std::size_t palette_size = 200;

std::array<glm::u8vec4, palette_size> palette() {
    std::mt19937 random(7);
    std::array<glm::u8vec4, palette_size> colours{};
    for (glm::u8vec4& colour : colours) {
        for (int k = 0; k < 4; ++k) {
            colour[k] = static_cast<std::uint8_t>(random() % 256);
        }
    }
    return colours;
}

std::vector<std::uint8_t> values_of(const glm::u8vec4& texel, Channels channels) {
    switch (channels) {
    case Channels::Grey:
        return {texel.r};
    case Channels::GreyAlpha:
        return {texel.r, texel.a};
    case Channels::Palette: {
        const auto colours = palette();
        return {
            static_cast<std::uint8_t>(std::find(colours.begin(), colours.end(), texel) - colours.begin())};
    }
    case Channels::Rgb:
        return {texel.r, texel.g, texel.b};
    default:
        return {texel.r, texel.g, texel.b, texel.a};
    }
}

/// A row as PNG and TIFF store it; 16-bit values in the order of `big`.
std::vector<std::uint8_t> row_of(const image::Image8& image, int y, const PictureForm& form, bool big) {
    std::vector<std::uint8_t> row;
    for (int x = 0; x < image.width; ++x) {
        for (const std::uint8_t code : values_of(image.at(x, y), form.channels)) {
            const int jitter = (x * 31 + y * 17) % 201 - 100; // less than half an 8-bit step
            const auto value = static_cast<std::uint16_t>(std::clamp(code * 257 + jitter, 0, 65535));
            if (form.depth == 8) {
                row.push_back(code);
            } else {
                row.push_back(static_cast<std::uint8_t>(big ? value >> 8 : value & 0xff));
                row.push_back(static_cast<std::uint8_t>(big ? value & 0xff : value >> 8));
            }
        }
    }
    return row;
}

void append(png_structp png, png_bytep bytes, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), size);
}

int colour_type_of(Channels channels) {
    switch (channels) {
    case Channels::Grey:
        return PNG_COLOR_TYPE_GRAY;
    case Channels::GreyAlpha:
        return PNG_COLOR_TYPE_GRAY_ALPHA;
    case Channels::Palette:
        return PNG_COLOR_TYPE_PALETTE;
    case Channels::Rgb:
        return PNG_COLOR_TYPE_RGB;
    default:
        return PNG_COLOR_TYPE_RGBA;
    }
}

/// A file in memory that libtiff writes.
struct Written {
    std::string bytes;
    std::size_t position = 0;
};

Written& written_of(thandle_t handle) {
    return *static_cast<Written*>(handle);
}

tmsize_t read_back(thandle_t handle, void* out, tmsize_t size) {
    Written& written = written_of(handle);
    const std::size_t count = written.bytes.copy(static_cast<char*>(out), static_cast<std::size_t>(size),
                                                 std::min(written.position, written.bytes.size()));
    written.position += count;
    return static_cast<tmsize_t>(count);
}

tmsize_t write_some(thandle_t handle, void* data, tmsize_t size) {
    Written& written = written_of(handle);
    const auto count = static_cast<std::size_t>(size);
    written.bytes.resize(std::max(written.bytes.size(), written.position + count));
    std::memcpy(written.bytes.data() + written.position, data, count);
    written.position += count;
    return size;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
    Written& written = written_of(handle);
    const std::size_t from = whence == SEEK_CUR   ? written.position
                             : whence == SEEK_END ? written.bytes.size()
                                                  : 0;
    return written.position = from + offset;
}

int close_nothing(thandle_t /*handle*/) {
    return 0;
}

toff_t size_of(thandle_t handle) {
    return written_of(handle).bytes.size();
}

void set_tiff_fields(TIFF* tiff, const image::Image8& image, const PictureForm& form) {
    const int channels = static_cast<int>(values_of(image.texels.front(), form.channels).size());
    const bool grey = form.channels == Channels::Grey || form.channels == Channels::GreyAlpha;
    const bool palettes = form.channels == Channels::Palette;
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, image.width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, image.height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, form.depth);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, channels);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, form.orientation);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, form.packed ? COMPRESSION_LZW : COMPRESSION_NONE);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                 palettes ? PHOTOMETRIC_PALETTE
                 : grey   ? PHOTOMETRIC_MINISBLACK
                          : PHOTOMETRIC_RGB);
    if (form.channels == Channels::Rgba || form.channels == Channels::GreyAlpha) {
        const std::uint16_t apart = EXTRASAMPLE_UNASSALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &apart);
    }
    if (palettes) {
        std::array<std::array<std::uint16_t, 256>, 3> colours{};
        const auto from = palette();
        for (std::size_t k = 0; k < from.size(); ++k) {
            for (int c = 0; c < 3; ++c) {
                colours.at(static_cast<std::size_t>(c)).at(k) =
                    static_cast<std::uint16_t>(from.at(k)[c] * 257);
            }
        }
        TIFFSetField(tiff, TIFFTAG_COLORMAP, colours[0].data(), colours[1].data(), colours[2].data());
    }
}

void write_tiles(TIFF* tiff, const image::Image8& image, const PictureForm& form) {
    constexpr int across = 32;
    constexpr int down = 16;
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, across);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, down);
    const std::size_t texel = row_of(image, 0, form, false).size() / static_cast<std::size_t>(image.width);
    for (int y = 0; y < image.height; y += down) {
        for (int x = 0; x < image.width; x += across) {
            std::vector<std::uint8_t> tile(texel * across * down);
            for (int k = 0; k < down && y + k < image.height; ++k) {
                const std::vector<std::uint8_t> row = row_of(image, y + k, form, false);
                const std::size_t begin = texel * static_cast<std::size_t>(x);
                const std::size_t count = std::min(row.size() - begin, texel * across);
                std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(begin), count,
                            tile.begin() +
                                static_cast<std::ptrdiff_t>(texel * across * static_cast<std::size_t>(k)));
            }
            TIFFWriteTile(tiff, tile.data(), static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0,
                          0);
        }
    }
}

} // namespace

image::Image8 random_picture_for(const PictureForm& form, int width, int height, std::uint32_t seed) {
    std::mt19937 random(seed);
    image::Image8 picture(width, height);
    const auto colours = palette();
    for (glm::u8vec4& texel : picture.texels) {
        if (form.channels == Channels::Palette) {
            texel = colours.at(random() % colours.size());
            continue;
        }
        for (int k = 0; k < 4; ++k) {
            texel[k] = static_cast<std::uint8_t>(random() % 256);
        }
        if (form.channels == Channels::Grey || form.channels == Channels::GreyAlpha) {
            texel.g = texel.b = texel.r;
        }
        if (form.channels == Channels::Grey || form.channels == Channels::Rgb) {
            texel.a = 255;
        }
    }
    return picture;
}

std::string png_in_form(const image::Image8& image, const PictureForm& form) {
    std::string file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                 form.depth, colour_type_of(form.channels),
                 form.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (form.channels == Channels::Palette) {
        std::array<png_color, palette_size> colours{};
        std::array<png_byte, palette_size> alphas{};
        const auto from = palette();
        for (std::size_t k = 0; k < palette_size; ++k) {
            colours.at(k) = {from.at(k).r, from.at(k).g, from.at(k).b};
            alphas.at(k) = from.at(k).a;
        }
        png_set_PLTE(png, info, colours.data(), palette_size);
        png_set_tRNS(png, info, alphas.data(), palette_size, nullptr);
    }
    png_write_info(png, info);
    std::vector<std::vector<std::uint8_t>> rows;
    std::vector<png_bytep> starts;
    for (int y = 0; y < image.height; ++y) {
        rows.push_back(row_of(image, y, form, true));
    }
    for (std::vector<std::uint8_t>& row : rows) {
        starts.push_back(row.data());
    }
    png_write_image(png, starts.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

std::string tiff_in_form(const image::Image8& image, const PictureForm& form) {
    Written written;
    TIFF* tiff = TIFFClientOpen("", "wl", &written, read_back, write_some, seek, close_nothing, size_of,
                                nullptr, nullptr);
    set_tiff_fields(tiff, image, form);
    if (form.rows_a_strip == 0) {
        write_tiles(tiff, image, form);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, form.rows_a_strip);
        for (int y = 0; y < image.height; ++y) {
            std::vector<std::uint8_t> row = row_of(image, y, form, false);
            TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0);
        }
    }
    TIFFClose(tiff);
    return written.bytes;
}

} // namespace frustumscreen::testing
