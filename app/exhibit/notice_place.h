/// The place of a notice on the table: beside the prop and beside everything shown to visitors, to which it gives
/// way.
///
/// A notice fades in at the best place, stays while it has space, and fades out before the next one. After losing its
/// place it returns once it has had space for half a second, so that a sliding prop does not make it appear and
/// vanish. It prefers a place beside everything else; then the place of a picture to choose that is not shown; then
/// the caption's place, where the caption dims meanwhile. Pictures to choose from, words and signs of guidance are
/// never covered: a notice waits until there is space.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: without space, nothing is shown.
#pragma once

#include "app/exhibit/notice_image.h"
#include "app/typography/captions.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

using SharedNotice = std::shared_ptr<const NoticePicture>;

struct PresentedNotice {
    SharedNotice picture;
    std::size_t shape = 0; ///< index into its shapes
    typography::TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
    double ring_full = 0.0;  ///< 0..1, where the shape has a ring
};

/// The notice's ring, as ring_around takes it; nothing if the shape has none.
[[nodiscard]] std::optional<typography::TablePolygon> notice_ring(const PresentedNotice& notice);

struct NoticeEnvironment {
    std::optional<typography::TablePolygon> shadow; ///< hidden_by_prop from the lens
    std::optional<typography::TablePolygon> hidden; ///< hidden_by_prop from the eye
    glm::dvec2 prop_m{0.0};
    int quarter_turns = 0; ///< the reader's side
    /// Together with `kept` and `caption` at most CaptionPlacer::max_obstacles.
    std::span<const typography::TableRectangle> obstacles;
    std::span<const typography::TableRectangle> kept; ///< empty places where a picture may come
    std::optional<typography::TableRectangle> caption;
};

class NoticePlace {
public:
    static constexpr Nanoseconds leaves = std::chrono::milliseconds(250); ///< fade out

    static constexpr Nanoseconds settles = std::chrono::milliseconds(500);
    static constexpr double border_m = 0.008; ///< from the picture's edge

    explicit NoticePlace(std::span<const glm::dvec2> picture_m) : placer_(picture_m, border_m, settles) {}

    /// Shows `wanted`, or nothing if it is null. Returns what is shown in this step.
    [[nodiscard]] std::optional<PresentedNotice> step(MonotonicTime now, const SharedNotice& wanted,
                                                      const NoticeEnvironment& environment);

private:
    void look(MonotonicTime now, const NoticeEnvironment& environment);

    typography::CaptionPlacer placer_;
    SharedNotice placed_; ///< the notice that has a place in `placer_`
    /// Things that the notice must not overlap. If there is no space, the next value is tried.
    enum class Beside : std::uint8_t { All, AllButEmptyPlaces, AllButCaption };
    Beside beside_ = Beside::All;
    double share_ = 0.0; ///< of its light; falls while another is wanted
    MonotonicTime last_;
};

/// Factor on the light of a caption that a notice covers, 0..1.
[[nodiscard]] double left_to_caption(const typography::TableRectangle& caption,
                                     const PresentedNotice& notice);

} // namespace frustumscreen::exhibit
