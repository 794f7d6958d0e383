/// Places a caption on the table: next to the prop, never on it, and at rest while the prop moves.
///
/// A caption lies flat on the table top, its baseline towards the side that the visitor reads from
/// (visitor_side.h); when the side changes, the caption fades out and in again, turned. The prop's shadow,
/// where the projector's rays hit the prop before the table, is kept clear; it covers the prop's footprint. A
/// caption dims as the shadow comes near and is dark when they touch, so it is never on the prop, however
/// fast the prop moves. A caption near the prop changes to a free place: it fades out, then fades in there.
///
/// Frames   table T, the plane z = 0; metres.
/// Time     `now` never goes back; fades are closed forms of it.
/// Threads  values; one caller. `update` and `at` allocate nothing.
/// Errors   none: if there is no free place, the caption is not shown.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::typography {

/// 24 pt, the smallest type on the table.
inline constexpr double min_caption_em_m = 24.0 * 0.0254 / 72.0;

/// A convex polygon, counter-clockwise; empty without points. There is space for a prop's shadow and a rectangle beside
/// it.
struct TablePolygon {
    std::array<glm::dvec2, geometry::max_corners + 4> points{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const glm::dvec2> corners() const { return std::span(points).first(count); }
};

/// Upright for a reader at the side `quarter_turns` of the table: 0 is the front edge, 1 the right one.
struct TableRectangle {
    glm::dvec2 centre_m{0.0};
    glm::dvec2 size_m{0.0}; ///< width and height as the reader sees them
    int quarter_turns = 0;
    /// Counter-clockwise from the reader's bottom left.
    [[nodiscard]] std::array<glm::dvec2, 4> corners() const;
};
[[nodiscard]] TablePolygon polygon_of(const TableRectangle& rectangle);

/// The part of the table that a convex prop hides from a point; for the lens this is the prop's shadow.
/// nullopt if the point is not above the whole prop: then the prop may hide anything.
[[nodiscard]] std::optional<TablePolygon> hidden_by_prop(const geometry::PropShape& prop,
                                                         const geometry::RigidTransform& table_from_prop,
                                                         const glm::dvec3& from_m);

/// The convex hull of both.
[[nodiscard]] TablePolygon hull_of(const TablePolygon& polygon, std::span<const glm::dvec2> points);

/// Distance between two convex shapes; 0 if they touch or overlap.
[[nodiscard]] double clearance(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b);

struct CaptionPlace {
    std::size_t shape = 0; ///< index into the given sizes
    TableRectangle rectangle;
    double opacity = 0.0; ///< 0 = do not draw
};

class CaptionPlacer {
public:
    /// `picture_m`: the convex part of the table that the picture covers; captions stay `border_m` inside. A
    /// caption that had to leave its place reappears only once its new place has been free for `settles`.
    explicit CaptionPlacer(std::span<const glm::dvec2> picture_m, double border_m = 0.008,
                           Nanoseconds settles = {});

    /// Sets another caption; its shapes (one for each width it was wrapped to) are in falling preference, at
    /// most `max_shapes`. It appears at the best place at the next update.
    void set_shapes(std::span<const glm::dvec2> sizes_m);

    /// Other things on the table, which captions avoid. At most `max_obstacles`.
    void set_obstacles(std::span<const TableRectangle> obstacles);
    static constexpr std::size_t max_obstacles = 24;
    static constexpr std::size_t max_shapes = 6;

    /// `shadow` and `hidden`: `hidden_by_prop` from the lens and from the eye. `quarter_turns`: the reader's
    /// side.
    void update(MonotonicTime now, const std::optional<TablePolygon>& shadow,
                const std::optional<TablePolygon>& hidden, const glm::dvec2& prop_m, int quarter_turns = 0);
    [[nodiscard]] CaptionPlace at(MonotonicTime now) const;
    /// True if the latest update searched for a place and found none.
    [[nodiscard]] bool searched_in_vain() const { return searched_in_vain_; }

private:
    struct Choice {
        std::size_t shape = 0;
        TableRectangle rectangle;
    };
    void turn_to(int quarter_turns);
    /// All arguments in the reader's frame: the table's, turned so that the reader is at the front.
    [[nodiscard]] std::optional<Choice> choose(const TablePolygon& shadow, const TablePolygon* hidden,
                                               const glm::dvec2& prop_m,
                                               std::span<const TableRectangle> obstacles) const;
    [[nodiscard]] bool inside_picture(const TableRectangle& rectangle) const;
    /// Both in the table's frame or both in the reader's.
    [[nodiscard]] static bool on_obstacle(const TableRectangle& rectangle,
                                          std::span<const TableRectangle> obstacles);

    std::vector<glm::dvec2> picture_m_; ///< in the reader's frame
    int quarter_turns_ = 0;             ///< rotation of that frame
    double border_m_;
    Nanoseconds settles_;
    bool comes_again_ = false; ///< it had to leave a place
    std::array<glm::dvec2, max_shapes> sizes_{};
    std::size_t size_count_ = 0;
    std::array<TableRectangle, max_obstacles> obstacles_{}; ///< in the table's frame
    std::size_t obstacle_count_ = 0;

    std::optional<Choice> place_;
    MonotonicTime appears_;                  ///< when it begins to fade in
    std::optional<MonotonicTime> leaves_;    ///< when it begins to fade out
    std::optional<MonotonicTime> next_look_; ///< after a failed search, the next one waits until then
    bool searched_in_vain_ = false;
    double clearance_m_ = 0.0; ///< between the caption and the shadow, at the last update
};

} // namespace frustumscreen::typography
