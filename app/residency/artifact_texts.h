/// What is said of an artifact, in each language that is shown. It is laid out when the pack is opened, as the exhibit must know
/// how large everything is; it is drawn only when it is about to be shown, in parts that come and go by themselves.
///
/// Units    metres on the table; coverage as in caption_image.h.
/// Threads  pure but for the file; any. Never in a frame.
/// Errors   as load_set_texts; no typeface where one is needed; a pack that is no longer the one that was laid out. Messages
///          begin with the file's name. A label that the bake could not set has no size, and no picture.
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

namespace frustumscreen {

/// Where an artifact's texts are.
struct TextSource {
    const std::filesystem::path& file;
    const PackDescription& pack;
    std::span<const std::size_t> captions; ///< of the pack, one for each language that is shown
};

/// Laid out.
struct ArtifactTexts {
    CatalogueEntry entry;
    std::vector<SharedRecording> recordings{}; ///< of the descriptions, by language; none: it is silent
};
/// `spoken`: recordings can be heard.
[[nodiscard]] Result<ArtifactTexts> lay_out_texts(const TextSource& source, double metres_per_box,
                                                  const TextStyle& style, bool spoken);

/// Captions are small, and are there before the artifact is. What is told of it can only be asked for once it is chosen.
enum class TextPart : std::uint8_t { Caption, Telling };
inline constexpr std::size_t text_parts = 2;

/// The part's pictures: of a caption by width, and by width again without its attribution, where there is one; of what is told by
/// portion and width, the attribution as the last portion, then the hotspots' labels.
[[nodiscard]] std::size_t portion_picture(std::size_t portion, std::size_t shape);
[[nodiscard]] std::size_t label_picture(const CatalogueEntry& entry, std::size_t language,
                                        std::size_t hotspot);
/// The GPU's memory that they take.
[[nodiscard]] std::uint64_t text_bytes(const CatalogueEntry& entry, TextPart part, std::size_t language,
                                       const TextStyle& style);

using TextPictures = std::vector<Image<std::uint8_t>>;
/// `texts`: laid out in this style. `given_up`: asked between two pictures; where it says yes, they are not drawn.
[[nodiscard]] Result<TextPictures> draw_texts(const TextSource& source, const ArtifactTexts& texts,
                                              TextPart part, std::size_t language, const TextStyle& style,
                                              const std::function<bool()>& given_up);

} // namespace frustumscreen
