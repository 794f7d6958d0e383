/// Sets a pack's texts as pictures: from the bake's glyph runs, in any script; without them, in the kiosk's
/// own typeface.
///
/// Units    metres on the table.
/// Threads  one caller, never in a frame.
/// Errors   no typeface where one is needed.
#pragma once

#include "app/pack/attribution.h"
#include "app/pack/pack.h"
#include "app/pack/pack_texts.h"
#include "app/typography/caption_image.h"
#include "firmware_host/base/result.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::residency {

/// Size and resolution of texts on this table.
struct TextStyle {
    double em_m = 0.010;
    double texels_per_m = 2400.0;
};

/// A part of a text that is set as one picture.
struct TextPiece {
    typography::CaptionRole role = typography::CaptionRole::Text;
    std::string key; ///< among the glyph runs (pack_texts.h)
    std::string text;
};
/// A text that is set as one picture.
struct TableText {
    std::string language; ///< BCP 47
    std::vector<TextPiece> pieces;
};
/// The title and the short text.
[[nodiscard]] TableText caption_text(const pack::PackCaption& caption);
[[nodiscard]] TableText portion_text(const pack::PackCaption& caption, std::size_t portion,
                                     const std::string& text);

/// The attribution of the artifact and its scan (attribution.h); empty: nothing is known. Packs baked before the
/// attribution was one text have its lines separately, in `set`.
[[nodiscard]] std::vector<TextPiece> attribution_pieces(const pack::PackCaption& caption,
                                                        const pack::ScanRights& rights,
                                                        std::span<const pack::SetLanguage> set,
                                                        typography::CaptionRole role);

/// Null if the language is missing.
[[nodiscard]] const pack::SetLanguage* find_language(std::span<const pack::SetLanguage> set,
                                                     const std::string& language);

class CaptionSetter {
public:
    explicit CaptionSetter(const TextStyle& style) : style_(style) {}

    /// One picture for each of `caption_widths_m`. `set`: the pack's own, which need not contain the text's
    /// language.
    [[nodiscard]] Result<std::vector<typography::CaptionImage>> set(const TableText& text,
                                                                    std::span<const pack::SetLanguage> set);
    /// The sizes of these pictures, without drawing them; the atlases of `set` are not used.
    [[nodiscard]] Result<std::vector<glm::dvec2>> sizes_m(const TableText& text,
                                                          std::span<const pack::SetLanguage> set);

private:
    [[nodiscard]] Result<void> open_typesetter();

    TextStyle style_;
    std::optional<typography::Typesetter> typesetter_; ///< opened for the first text without glyph runs
};

} // namespace frustumscreen::residency
