#include "assets_baked/bake/loaders/film_file.h"

#include "assets_baked/bake/loaders/decode_image.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <webp/demux.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace frustumscreen::bake {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_film_bytes = std::uintmax_t{512} << 20;
constexpr std::uintmax_t max_picture_bytes = std::uintmax_t{64} << 20;

const std::uint8_t* raw(const Bytes& bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

struct DemuxCloser {
    void operator()(WebPDemuxer* demux) const { WebPDemuxDelete(demux); }
};
struct DecoderCloser {
    void operator()(WebPAnimDecoder* decoder) const { WebPAnimDecoderDelete(decoder); }
};

bool is_sequence(const fs::path& film) {
    std::error_code none;
    return fs::is_directory(film, none) || film.filename().string().find('*') != std::string::npos;
}

/// "frame 9" comes before "frame 10".
bool before(const fs::path& left, const fs::path& right) {
    const std::string a = left.filename().string();
    const std::string b = right.filename().string();
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (digit(a[i]) && digit(b[j])) {
            const auto number = [&](const std::string& text, std::size_t& at) {
                while (at < text.size() && text[at] == '0') {
                    ++at;
                }
                const std::size_t begin = at;
                while (at < text.size() && digit(text[at])) {
                    ++at;
                }
                return text.substr(begin, at - begin);
            };
            const std::string x = number(a, i);
            const std::string y = number(b, j);
            if (x != y) {
                return x.size() != y.size() ? x.size() < y.size() : x < y;
            }
        } else if (a[i] != b[j]) {
            return a[i] < b[j];
        } else {
            ++i;
            ++j;
        }
    }
    return a.size() - i < b.size() - j || (a.size() - i == b.size() - j && a < b);
}

Result<void> check_extent(const fs::path& file, std::int64_t width, std::int64_t height,
                          const FilmLimits& limits) {
    if (std::min(width, height) < limits.min_side || std::max(width, height) > limits.max_side) {
        return bad_input("film.size",
                         "{}: its frames have {} x {} pixels; allowed are {} to {} a side: make them of "
                         "such a size",
                         file.string(), width, height, limits.min_side, limits.max_side);
    }
    return {};
}

Result<void> check_count(const fs::path& film, std::uint64_t frames, const FilmLimits& limits) {
    if (frames < 2 || frames > limits.max_frames) {
        return bad_input("film.frames", "{}: it has {} frame{}; allowed are 2 to {}: {}", film.string(),
                         frames, frames == 1 ? "" : "s", limits.max_frames,
                         frames < 2 ? "for a still picture write picture = \"...\""
                                    : "leave out every second");
    }
    return {};
}

Result<std::vector<fs::path>> pictures_of(const fs::path& film, const FilmLimits& limits) {
    std::vector<fs::path> files = files_of_film(film);
    if (files.empty()) {
        return bad_input("film.no_pictures",
                         "{}: there is no picture of this name; write the name of a folder with the frames, "
                         "or one * where their names differ",
                         film.string());
    }
    TRY_VOID(check_count(film, files.size(), limits));
    return files;
}

Result<image::Image8> read_picture(const fs::path& file, const FilmLimits& limits) {
    TRY(const Bytes bytes, read_file(file, max_picture_bytes));
    const std::int64_t max_texels = std::int64_t{limits.max_side} * limits.max_side;
    TRY(image::Image8 picture, at(file.string(), decode_image(bytes, max_texels)));
    TRY_VOID(check_extent(file, picture.width, picture.height, limits));
    return picture;
}

/// An animated WebP whose frames are not decoded yet.
struct Animation {
    Bytes bytes;
    FilmOutline outline;
};

tl::unexpected<Error> damaged(const fs::path& film) {
    return bad_input("film.damaged",
                     "{}: the animated WebP is damaged or cut off; copy it again, or export it again",
                     film.string());
}

/// Frames are shown for their own time each; a pack's film has one rate.
void read_times(WebPDemuxer& demux, FilmOutline& outline) {
    WebPIterator frame;
    std::int64_t all_ms = 0;
    int shortest_ms = 1 << 24;
    int longest_ms = 0;
    if (WebPDemuxGetFrame(&demux, 1, &frame) != 0) {
        do {
            all_ms += frame.duration;
            shortest_ms = std::min(shortest_ms, frame.duration);
            longest_ms = std::max(longest_ms, frame.duration);
        } while (WebPDemuxNextFrame(&frame) != 0);
    }
    WebPDemuxReleaseIterator(&frame);
    outline.is_even = longest_ms - shortest_ms <= 1;
    outline.rate_hz = 1e3 * outline.frames / static_cast<double>(std::max<std::int64_t>(all_ms, 1));
}

Result<Animation> open_animation(const fs::path& film, const FilmLimits& limits) {
    TRY(Bytes bytes, read_file(film, max_film_bytes));
    if (!image::begins_as_webp(bytes)) {
        return bad_input("film.no_film",
                         "{}: it is not an animated WebP; allowed are such a file, a folder of pictures, and "
                         "pictures named with one *",
                         film.string());
    }
    const WebPData data{raw(bytes), bytes.size()};
    const std::unique_ptr<WebPDemuxer, DemuxCloser> demux(WebPDemux(&data));
    if (!demux) {
        return damaged(film);
    }
    FilmOutline outline;
    const std::uint32_t width = WebPDemuxGetI(demux.get(), WEBP_FF_CANVAS_WIDTH);
    const std::uint32_t height = WebPDemuxGetI(demux.get(), WEBP_FF_CANVAS_HEIGHT);
    outline.frames = WebPDemuxGetI(demux.get(), WEBP_FF_FRAME_COUNT);
    outline.bytes = bytes.size();
    TRY_VOID(check_count(film, outline.frames, limits));
    TRY_VOID(check_extent(film, width, height, limits));
    outline.width = static_cast<int>(width);
    outline.height = static_cast<int>(height);
    read_times(*demux, outline);
    return Animation{std::move(bytes), outline};
}

Result<void> read_animation(const fs::path& film, const FilmLimits& limits,
                            const std::function<void(image::Image8 frame)>& take) {
    TRY(const Animation animation, open_animation(film, limits));
    WebPAnimDecoderOptions options;
    if (WebPAnimDecoderOptionsInit(&options) == 0) {
        return damaged(film);
    }
    options.color_mode = MODE_RGBA;
    const WebPData data{raw(animation.bytes), animation.bytes.size()};
    const std::unique_ptr<WebPAnimDecoder, DecoderCloser> decoder(WebPAnimDecoderNew(&data, &options));
    if (!decoder) {
        return damaged(film);
    }
    for (std::uint32_t k = 0; k < animation.outline.frames; ++k) {
        std::uint8_t* texels = nullptr;
        int end_ms = 0;
        if (WebPAnimDecoderGetNext(decoder.get(), &texels, &end_ms) == 0) {
            return damaged(film);
        }
        image::Image8 frame(animation.outline.width, animation.outline.height);
        std::copy_n(texels, 4 * frame.texels.size(), &frame.texels[0].x);
        take(std::move(frame));
    }
    return {};
}

} // namespace

std::vector<fs::path> files_of_film(const fs::path& film) {
    if (!is_sequence(film)) {
        return {film};
    }
    std::error_code none;
    const bool is_folder = fs::is_directory(film, none);
    const std::string pattern = is_folder ? "*" : film.filename().string();
    const std::size_t star = pattern.find('*');
    const std::string head = pattern.substr(0, star);
    const std::string tail = pattern.substr(star + 1);
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(is_folder ? film : film.parent_path(), none)) {
        const std::string name = entry.path().filename().string();
        if (entry.is_regular_file(none) && !name.starts_with('.') &&
            name.size() >= head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail)) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end(), before);
    return files;
}

Result<FilmOutline> outline_of_film(const fs::path& film, const FilmLimits& limits) {
    if (!is_sequence(film)) {
        TRY(const Animation animation, open_animation(film, limits));
        return animation.outline;
    }
    TRY(const std::vector<fs::path> files, pictures_of(film, limits));
    TRY(const image::Image8 first, read_picture(files.front(), limits));
    FilmOutline outline;
    outline.width = first.width;
    outline.height = first.height;
    outline.frames = static_cast<std::uint32_t>(files.size());
    for (const fs::path& file : files) {
        std::error_code unknown;
        const std::uintmax_t bytes = fs::file_size(file, unknown);
        outline.bytes += unknown ? 0 : bytes;
    }
    return outline;
}

Result<void> read_film(const fs::path& film, const FilmLimits& limits,
                       const std::function<void(image::Image8 frame)>& take) {
    if (!is_sequence(film)) {
        return read_animation(film, limits, take);
    }
    TRY(const std::vector<fs::path> files, pictures_of(film, limits));
    std::optional<glm::ivec2> size;
    for (const fs::path& file : files) {
        TRY(image::Image8 frame, read_picture(file, limits));
        const glm::ivec2 its(frame.width, frame.height);
        if (size && *size != its) {
            return bad_input(
                "film.other_size",
                "{}: this frame has {} x {} pixels, those before it {} x {}; allowed is one size",
                file.string(), its.x, its.y, size->x, size->y);
        }
        size = its;
        take(std::move(frame));
    }
    return {};
}

} // namespace frustumscreen::bake
