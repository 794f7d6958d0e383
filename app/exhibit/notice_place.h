/// Where on the table a notice lies: beside the prop and beside what visitors are shown there, and it gives way to that.
///
/// A notice fades in at the best place that there is, stays there while it has room, and fades out before the next one comes.
/// Where it had to leave, it comes again once it has had room for half a second: a prop that is slid about does not make it come
/// and go. It lies beside all else;
/// without room there, where a picture to choose would lie that is not shown now; then in the caption's place, which dims
/// meanwhile. Pictures to choose from, words and signs of guidance are never covered: a notice waits until there is room.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: without room nothing is shown.
#pragma once

#include "app/exhibit/notice_image.h"
#include "app/typography/captions.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace frustumscreen {

using SharedNotice = std::shared_ptr<const NoticePicture>;

struct PresentedNotice {
    SharedNotice picture;
    std::size_t shape = 0; ///< index into its shapes
    TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
    double ring_full = 0.0;  ///< 0..1, where the shape has a ring
};

/// The notice's ring as ring_around takes it; nothing where the shape has none.
[[nodiscard]] std::optional<TablePolygon> notice_ring(const PresentedNotice& notice);

struct NoticeEnvironment {
    std::optional<TablePolygon> shadow; ///< hidden_by_prop from the lens
    std::optional<TablePolygon> hidden; ///< and from the eye
    glm::dvec2 prop_m{0.0};
    int quarter_turns = 0; ///< the reader's side
    /// With the kept ones and the caption at most CaptionPlacer::max_obstacles.
    std::span<const TableRectangle> obstacles;
    std::span<const TableRectangle> kept; ///< empty places, where something may come
    std::optional<TableRectangle> caption;
};

class NoticePlace {
public:
    static constexpr Nanoseconds leaves = std::chrono::milliseconds(250); ///< to fade out

    static constexpr Nanoseconds settles = std::chrono::milliseconds(500);
    static constexpr double border_m = 0.008; ///< from the picture's edge

    explicit NoticePlace(std::span<const glm::dvec2> picture_m) : placer_(picture_m, border_m, settles) {}

    /// `wanted` is shown, or nothing more. Returns what is.
    [[nodiscard]] std::optional<PresentedNotice> step(MonotonicTime now, const SharedNotice& wanted,
                                                      const NoticeEnvironment& environment);

private:
    void look(MonotonicTime now, const NoticeEnvironment& environment);

    CaptionPlacer placer_;
    SharedNotice lies_; ///< that the placer has
    /// What it lies beside: the next one is tried where there was no room.
    enum class Beside : std::uint8_t { All, AllButEmptyPlaces, AllButCaption };
    Beside beside_ = Beside::All;
    double share_ = 0.0; ///< of its light; it falls while another is wanted
    MonotonicTime last_;
};

/// How much light is left to a caption that a notice lies on, 0..1.
[[nodiscard]] double left_to_caption(const TableRectangle& caption, const PresentedNotice& notice);

} // namespace frustumscreen
