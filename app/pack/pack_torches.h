/// The section `torches` of a pack: what a torch can throw onto the artifact.
///
/// Pictures   WebP parts `torches/picture_N.webp`, sRGB with alpha, at most max_picture_px a side.
/// Films      WebP parts `torches/film_N/00000.webp`, ..., so that each frame can be read alone.
/// Layers     another texture of the same surface, for each level that the pack has and each relief: parts
///            `torches/layer_N/...` (FORMAT.md).
/// Errors     one line: data that FORMAT.md does not allow. Messages of `load_...` begin with the file's name. A pack
///            without the section is no error: it has no contents.
/// Threads    pure; any.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/torch/content.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::pack {

inline constexpr std::size_t max_contents = 16, max_layers = 4, max_films = 4, max_film_frames = 600;
inline constexpr int max_torch_picture_px = 2048, max_film_px = 1024;

struct PackTorchContent {
    torch::Content content;        ///< Stage::item: index into `pictures`, `films` or `layers`
    std::vector<PackLabel> titles; ///< what visitors are told ("X-ray"), in each language

    [[nodiscard]] bool operator==(const PackTorchContent&) const = default;
};
struct PackFilm {
    int width = 0, height = 0;
    std::uint32_t frames = 0;
    double rate_hz = 25.0;
    std::vector<std::string> parts{}; ///< one a frame

    [[nodiscard]] bool operator==(const PackFilm&) const = default;
};
struct PackTorches {
    std::vector<PackTorchContent> contents;
    std::vector<std::string> pictures; ///< parts
    std::vector<PackFilm> films;
    std::vector<std::string> layers; ///< names; layer_parts.h names their parts

    [[nodiscard]] bool empty() const { return contents.empty(); }
    [[nodiscard]] bool operator==(const PackTorches&) const = default;
};

/// From the manifest alone.
[[nodiscard]] Result<PackTorches> torches_of(const PackDescription& pack);

} // namespace frustumscreen::pack
