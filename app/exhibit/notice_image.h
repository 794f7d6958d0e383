/// What is told of a stick as pictures to lay on the table, in several shapes, and where its ring is in each.
///
/// Sentences are set over lines. A line has a pack's title beside what became of it, in narrow shapes above it. Languages that run
/// from right to left are mirrored: the title is at the right. A title or a file's name that the kiosk's typeface cannot set, as it
/// shapes no letters, is left out for the other one, then for a dash.
///
/// Units    metres on the table; type of 24 pt, sentences larger, as a caption's title. Coverage is linear light, 255 = white; row 0 at the top.
/// Threads  as Typesetter; never in a frame.
/// Errors   none: a word that is not there is left out.
#pragma once

#include "app/exhibit/stick_notice.h"
#include "app/pack/glyph_runs.h"
#include "app/typography/caption_image.h"
#include "app/typography/text_image.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace frustumscreen {

inline constexpr double notice_ring_radius_m = 0.007; ///< of what the ring lies around (ring.h)

struct NoticeShape {
    CaptionImage image;
    std::optional<glm::dvec2> ring_m; ///< its middle, from the picture's, as the reader sees it: right, up
};
struct NoticePicture {
    NoticeText text;
    std::vector<NoticeShape> shapes;
    std::vector<glm::dvec2> sizes_m; ///< of the shapes, in falling preference, at most four
};

struct NoticeType {
    const GlyphRuns& runs; ///< of the exhibit's own words
    const DistanceAtlas& atlas;
    const Typesetter& typesetter;
    double texels_per_m = 2400.0;
};
/// `counts`: the same with fewer lines, for shapes where all of them may find no room.
[[nodiscard]] NoticePicture draw_notice(const NoticeText& text, const NoticeText& counts,
                                        const NoticeType& type);

} // namespace frustumscreen
