/// Chooses the view that the next press pins: first what the prop shows, then, while the prop hardly moves, the
/// artifact's states one by one in the same view.
///
/// Frames   table T, metres.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/geometry/transform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace frustumscreen::exhibit {

/// A view to pin: what an eye sees of an artifact through the prop.
struct ViewToPin {
    std::optional<std::size_t> state; ///< none: as the prop shows it
    glm::dvec3 eye_m{0.0};
    geometry::RigidTransform table_from_prop;
};

class WindowHistory {
public:
    /// A prop that moves farther begins a new history.
    static constexpr double max_move_m = 0.010, max_turn_deg = 5.0;

    /// The view that a press pins now. `seen`: what the prop shows, without a state. `states`: how many the artifact has.
    [[nodiscard]] ViewToPin next(std::size_t artifact, std::size_t states, const ViewToPin& seen) const {
        if (!first_ || artifact != artifact_ || pinned_ > states || moved(seen)) {
            return seen;
        }
        return {pinned_ - 1, first_->eye_m, first_->table_from_prop};
    }
    /// Call when `view` was pinned.
    void note(std::size_t artifact, const ViewToPin& view) {
        if (!view.state) {
            artifact_ = artifact;
            first_ = view;
        }
        pinned_ = view.state ? *view.state + 2 : 1;
    }
    /// Forgets the history: the next press pins what the prop shows.
    void forget() { first_.reset(); }

private:
    [[nodiscard]] bool moved(const ViewToPin& seen) const {
        const geometry::RigidTransform& before = first_->table_from_prop;
        const double cosine = std::abs(glm::dot(before.rotation, seen.table_from_prop.rotation));
        const double turn_deg = 2.0 * std::acos(std::min(1.0, cosine)) * 180.0 / std::numbers::pi;
        return !(glm::distance(before.translation, seen.table_from_prop.translation) <= max_move_m) ||
               !(turn_deg <= max_turn_deg);
    }

    std::size_t artifact_ = 0;
    std::optional<ViewToPin> first_;
    std::size_t pinned_ = 0; ///< windows of this history
};

} // namespace frustumscreen::exhibit
