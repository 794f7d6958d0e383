/// Reads a film: an animated WebP, a folder of pictures, or pictures whose names differ in one place ("growth-*.png").
///
/// Order    of pictures: by name, numbers in it by their value.
/// Errors   one sentence that begins with the file's name: no film, damaged, too few or too many frames, a side that is
///          not allowed, frames of different sizes. Sizes and counts are checked before a frame is decoded.
/// Memory   the file, and one frame at a time.
/// Threads  pure apart from reading the files; `take` is called on the caller's thread.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace frustumscreen::bake {

struct FilmLimits {
    int min_side = 1, max_side = 1; ///< pixels
    std::uint32_t max_frames = 1;
};
struct FilmOutline {
    int width = 0, height = 0;
    std::uint32_t frames = 0;
    std::optional<double> rate_hz; ///< of the file; nothing: single pictures
    bool is_even = true;           ///< false: frames of the file are shown for different times
    std::uint64_t bytes = 0;       ///< of its files
};

/// Reads what comes before the first frame; of single pictures, the first one.
[[nodiscard]] Result<FilmOutline> outline_of_film(const std::filesystem::path& film,
                                                  const FilmLimits& limits);
/// Calls `take` with each frame.
[[nodiscard]] Result<void> read_film(const std::filesystem::path& film, const FilmLimits& limits,
                                     const std::function<void(image::Image8 frame)>& take);
/// The files that the film is made of.
[[nodiscard]] std::vector<std::filesystem::path> files_of_film(const std::filesystem::path& film);

} // namespace frustumscreen::bake
