#include "app/exhibit/caption_image.h"

#include "app/exhibit/captions.h"

#include <algorithm>

namespace frustumscreen {

namespace {

constexpr double title_em = 1.35;
constexpr double text_brightness = 0.8; ///< linear; a little behind the title

} // namespace

CaptionImage make_caption(const Typesetter& typesetter, const std::string& title, const std::string& text,
                          double em_m, double width_m, double texels_per_m) {
    const double em_px = std::max(em_m, least_caption_em_m) * texels_per_m;
    std::vector<Paragraph> paragraphs;
    if (!title.empty()) {
        paragraphs.push_back({title, title_em * em_px, true, 1.0, 0.0});
    }
    if (!text.empty()) {
        paragraphs.push_back({text, em_px, false, text_brightness, 0.3 * em_px});
    }
    CaptionImage caption;
    caption.coverage = typesetter.set(paragraphs, width_m * texels_per_m);
    caption.size_m = glm::dvec2(caption.coverage.width, caption.coverage.height) / texels_per_m;
    return caption;
}

} // namespace frustumscreen
