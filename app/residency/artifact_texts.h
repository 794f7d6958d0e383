/// An artifact's texts, in each language that is shown. They are laid out when the pack is opened, because
/// the exhibit must know all sizes; they are drawn shortly before they are shown, in parts that are loaded
/// and released independently.
///
/// Units    metres on the table; coverage as in caption_image.h.
/// Threads  pure except for reading the file; any. Never in a frame.
/// Errors   as load_set_texts; no typeface where one is needed; a pack that has changed since the layout.
///          Messages begin with the file's name. A label or title that the bake could not set has size 0 and
///          no picture.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/residency/caption_setter.h"
#include "app/residency/prompt_reader.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace frustumscreen::residency {

/// The source of an artifact's texts.
struct TextSource {
    const std::filesystem::path& file;
    const pack::PackDescription& pack;
    std::span<const std::size_t> captions; ///< of the pack, one per language that is shown
    bool contents = false; ///< there are torches: the titles of what they throw are laid out too
    bool states = false;   ///< there are windows: the titles of the states are laid out too
};

/// The layout of an artifact's texts.
struct ArtifactTexts {
    exhibit::CatalogueEntry entry;
    std::vector<SharedRecording> recordings{}; ///< of the descriptions, by language; null: silent
};
/// `spoken`: sound is on.
[[nodiscard]] Result<ArtifactTexts> lay_out_texts(const TextSource& source, double metres_per_box,
                                                  const TextStyle& style, bool spoken);

/// Captions are small and are loaded before the artifact. The narration can only be requested once the
/// artifact is chosen.
enum class TextPart : std::uint8_t { Caption, Narration };
inline constexpr std::size_t text_parts = 2;

/// The part's pictures, in this order. Caption: by width; by width again without its attribution, if it has one; titles of
/// behaviours, of torches' contents and of states. Narration: by portion and width, the attribution as the last portion;
/// labels of the hotspots.
[[nodiscard]] std::size_t portion_picture(std::size_t portion, std::size_t shape);
[[nodiscard]] std::size_t label_picture(const exhibit::CatalogueEntry& entry, std::size_t language,
                                        std::size_t hotspot);
[[nodiscard]] std::size_t title_picture(const exhibit::CatalogueEntry& entry, std::size_t language,
                                        std::size_t behaviour);
[[nodiscard]] std::size_t state_picture(const exhibit::CatalogueEntry& entry, std::size_t language,
                                        std::size_t state);
/// GPU memory of a part's pictures.
[[nodiscard]] std::uint64_t text_bytes(const exhibit::CatalogueEntry& entry, TextPart part,
                                       std::size_t language, const TextStyle& style);

using TextPictures = std::vector<image::Image<std::uint8_t>>;
/// `texts`: laid out in this style. `given_up`: asked between two pictures; true cancels the drawing.
[[nodiscard]] Result<TextPictures> draw_texts(const TextSource& source, const ArtifactTexts& texts,
                                              TextPart part, std::size_t language, const TextStyle& style,
                                              const std::function<bool()>& given_up);

} // namespace frustumscreen::residency
