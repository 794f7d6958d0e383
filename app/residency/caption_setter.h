/// Sets a pack's texts as pictures: from the glyph runs that the bake made, in any script; without them in the kiosk's own
/// typeface.
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

namespace frustumscreen {

/// How texts are set on this table.
struct TextStyle {
    double em_m = 0.010;
    double texels_per_m = 2400.0;
};

/// A part of what is set as one picture.
struct TextPiece {
    CaptionRole role = CaptionRole::Text;
    std::string key; ///< among the glyph runs (pack_texts.h)
    std::string text;
};
/// What is set as one picture.
struct TableText {
    std::string language; ///< BCP 47
    std::vector<TextPiece> pieces;
};
/// The title and the short text.
[[nodiscard]] TableText caption_text(const PackCaption& caption);
[[nodiscard]] TableText portion_text(const PackCaption& caption, std::size_t portion,
                                     const std::string& text);

/// Whose the artifact and its scan are (attribution.h); none: nothing is known. Packs that were baked before the attribution was
/// set as one text have its lines apart, in `set`.
[[nodiscard]] std::vector<TextPiece> attribution_pieces(const PackCaption& caption, const ScanRights& rights,
                                                        std::span<const SetLanguage> set, CaptionRole role);

/// Null if there is none in this language.
[[nodiscard]] const SetLanguage* find_language(std::span<const SetLanguage> set, const std::string& language);

class CaptionSetter {
public:
    explicit CaptionSetter(const TextStyle& style) : style_(style) {}

    /// One for each of `caption_widths_m`. `set`: the pack's own, which need not hold the text's language.
    [[nodiscard]] Result<std::vector<CaptionImage>> set(const TableText& text,
                                                        std::span<const SetLanguage> set);
    /// Of these pictures, without drawing them: the atlases of `set` are not looked at.
    [[nodiscard]] Result<std::vector<glm::dvec2>> sizes_m(const TableText& text,
                                                          std::span<const SetLanguage> set);

private:
    [[nodiscard]] Result<void> open_typesetter();

    TextStyle style_;
    std::optional<Typesetter> typesetter_; ///< opened for the first text without glyph runs
};

} // namespace frustumscreen
