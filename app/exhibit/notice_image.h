/// A notice about a stick as pictures on the table, in several shapes, with the place of the ring in each.
///
/// Sentences are set above lines. A line has a pack's title beside its outcome, in narrow shapes above it. For
/// languages that run from right to left the picture is mirrored: the title is at the right. If the kiosk's typeface,
/// which does not shape letters, cannot set the title, the file's name takes its place; if it cannot set that either,
/// a dash.
///
/// Units    metres on the table; type of 24 pt; sentences are larger, as a caption's title. Coverage is linear light,
///          255 = white; row 0 at the top.
/// Threads  as Typesetter; never in a frame.
/// Errors   none: a missing word is left out.
#pragma once

#include "app/exhibit/stick_notice.h"
#include "app/pack/glyph_runs.h"
#include "app/typography/caption_image.h"
#include "app/typography/text_image.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace frustumscreen::exhibit {

inline constexpr double notice_ring_radius_m = 0.007; ///< of what the ring surrounds (ring.h)

struct NoticeShape {
    typography::CaptionImage image;
    std::optional<glm::dvec2> ring_m; ///< middle, relative to the picture's; the reader's right, up
};
struct NoticePicture {
    NoticeText text;
    std::vector<NoticeShape> shapes;
    std::vector<glm::dvec2> sizes_m; ///< of the shapes, in falling preference, at most four
};

struct NoticeType {
    const pack::GlyphRuns& runs; ///< of the exhibit's own texts
    const pack::DistanceAtlas& atlas;
    const typography::Typesetter& typesetter;
    double texels_per_m = 2400.0;
};
/// `counts`: the same notice with fewer lines, for shapes in which all lines may not fit.
[[nodiscard]] NoticePicture draw_notice(const NoticeText& text, const NoticeText& counts,
                                        const NoticeType& type);

} // namespace frustumscreen::exhibit
