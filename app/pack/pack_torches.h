/// The section `torches` of a pack: what a torch can throw onto the artifact.
///
/// Pictures   WebP parts `torches/picture_N.webp`, sRGB with alpha, at most max_torch_picture_px a side.
/// Films      WebP parts `torches/film_N/00000.webp`, ..., so that each frame can be read alone.
/// Layers     another texture of the same surface, with its own alpha: a picture in place of each texture that the pack
///            has (parts `torches/layer_N/0.webp`, ..., of the same size), and other colours for the corners of each
///            relief (`torches/layer_N/relief_96.bin`, ..., by the relief's texels). The pack of a cell has a section of its
///            own with the same layers and no content.
/// Errors     one line: data that FORMAT.md does not allow. Messages of `load_...` begin with the file's name. A pack
///            without the section is no error: it has no contents.
/// Threads    pure; any.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/torch/content.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::pack {

inline constexpr std::size_t max_contents = 16, max_layers = 4, max_films = 4, max_film_frames = 600;
inline constexpr int min_torch_picture_px = 8, max_torch_picture_px = 2048, max_film_px = 1024;

struct PackTorchContent {
    torch::Content content;        ///< Stage::item: index into `pictures`, `films` or `layers`
    std::vector<PackLabel> titles; ///< what visitors are told ("X-ray"), in each language

    [[nodiscard]] bool operator==(const PackTorchContent&) const = default;
};
struct PackTorchPicture {
    int width = 0, height = 0;
    std::string part{};

    [[nodiscard]] bool operator==(const PackTorchPicture&) const = default;
};
struct PackFilm {
    int width = 0, height = 0;
    std::uint32_t frames = 0;
    double rate_hz = 25.0;
    std::vector<std::string> parts{}; ///< one a frame

    [[nodiscard]] bool operator==(const PackFilm&) const = default;
};
struct PackLayer {
    std::string name;
    std::vector<std::string> textures{}; ///< parts, in the order of Pack::textures
    std::vector<std::string> reliefs{};  ///< parts, in the order of reliefs_of

    [[nodiscard]] bool operator==(const PackLayer&) const = default;
};
struct PackTorches {
    std::vector<PackTorchContent> contents;
    std::vector<PackTorchPicture> pictures;
    std::vector<PackFilm> films;
    std::vector<PackLayer> layers;

    [[nodiscard]] bool empty() const { return contents.empty() && layers.empty(); }
    [[nodiscard]] bool operator==(const PackTorches&) const = default;
};

/// From the manifest alone.
[[nodiscard]] Result<PackTorches> torches_of(const PackDescription& pack);

/// Bytes of the parts, in the order of PackTorches, where `part` and `parts` are not read.
struct TorchParts {
    std::vector<Bytes> pictures;
    std::vector<std::vector<Bytes>> films;
    struct Layer {
        std::vector<Bytes> textures, reliefs;
    };
    std::vector<Layer> layers;
};
/// Call once for a pack, after put_reliefs; nothing is put for no content and no layer. Errors: what torches_of refuses.
[[nodiscard]] Result<void> put_torches(Pack& pack, PackTorches torches, TorchParts parts);

/// These read only the manifest and the part in question.
[[nodiscard]] Result<image::Image8> load_torch_picture(const std::filesystem::path& file,
                                                       const PackTorchPicture& picture);
[[nodiscard]] Result<image::Image8> load_film_frame(const std::filesystem::path& file, const PackFilm& film,
                                                    std::uint32_t frame);
/// All frames, still packed: to be decoded one by one with film_frame_of while the film runs.
[[nodiscard]] Result<std::vector<Bytes>> load_film(const std::filesystem::path& file, const PackFilm& film);
[[nodiscard]] Result<image::Image8> film_frame_of(const PackFilm& film, std::span<const std::byte> frame);
/// In place of the pack's texture of that number.
[[nodiscard]] Result<image::Image8> load_layer_texture(const std::filesystem::path& file,
                                                       const PackLayer& layer, std::size_t texture);
/// In place of BlockRelief::colours of the relief of that number, which has `corners` of them.
[[nodiscard]] Result<std::vector<glm::u8vec4>> load_layer_colours(const std::filesystem::path& file,
                                                                  const PackLayer& layer, std::size_t relief,
                                                                  std::size_t corners);

/// The same of a pack that was read whole, such as that of a cell.
[[nodiscard]] Result<image::Image8> layer_texture_of(const Pack& pack, const PackLayer& layer,
                                                     std::size_t texture);
[[nodiscard]] Result<std::vector<glm::u8vec4>> layer_colours_of(const Pack& pack, const PackLayer& layer,
                                                                std::size_t relief, std::size_t corners);

/// Checks the section and all its parts against FORMAT.md; `pack` was read whole.
[[nodiscard]] Result<void> check_torches(const Pack& pack);

} // namespace frustumscreen::pack
