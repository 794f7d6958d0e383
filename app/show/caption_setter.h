/// Sets a pack's captions as pictures: from the glyph runs that the bake made, in any script; without them in the kiosk's own
/// typeface.
///
/// Threads  one caller, never in a frame.
/// Errors   no typeface where one is needed.
#pragma once

#include "app/exhibit/caption_image.h"
#include "app/pack/pack.h"
#include "app/pack/pack_texts.h"
#include "firmware_host/base/result.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// A portion of a description.
struct SetPortion {
    std::vector<CaptionImage> images; ///< one for each of `caption_widths_m`
    bool flush_right = false;         ///< its lines begin at the right
};

class CaptionSetter {
public:
    CaptionSetter(double em_m, double texels_per_m) : em_m_(em_m), texels_per_m_(texels_per_m) {}

    /// One for each of `caption_widths_m`. `set`: the pack's own, which need not hold the caption's language.
    [[nodiscard]] Result<std::vector<CaptionImage>> set(const PackCaption& caption,
                                                        std::span<const SetLanguage> set);

    /// `key`: as portion_key gives it; `set` as above.
    [[nodiscard]] Result<SetPortion> set_portion(const std::string& language, const std::string& key,
                                                 const std::string& text, std::span<const SetLanguage> set);

private:
    [[nodiscard]] Result<void> open_typesetter();

    double em_m_;
    double texels_per_m_;
    std::optional<Typesetter> typesetter_; ///< opened for the first caption without glyph runs
};

} // namespace frustumscreen
