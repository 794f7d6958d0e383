/// When a visitor is guided: only while present, where the exhibit's state permits, and not on the way to a picture on
/// the table.
///
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/exhibit/idle_pose.h"
#include "app/exhibit/presence.h"
#include "app/exhibit/sensed.h"
#include "app/exhibit/table_browser.h"
#include "app/guidance/guide.h"

#include <optional>
#include <span>

namespace frustumscreen::exhibit {

struct VisitorGuideInput {
    const tracking::TrackedState& tracked_state;
    const DrawnPose& drawn;
    const Presence& presence;
    bool lost = false;                   ///< the prop's pose has been unknown for a while
    bool permitted = true;               ///< by the exhibit's state
    bool help = false;                   ///< help is requested
    bool may_speak = true;               ///< as Guide::step
    const TableBrowser* table = nullptr; ///< null: no pictures on the table
    std::span<const glm::dvec3> hull;    ///< as Guide::show
};

class VisitorGuide {
public:
    /// `setup`: none: no guidance.
    explicit VisitorGuide(const std::optional<guidance::GuidanceSetup>& setup);

    void step(MonotonicTime now, const VisitorGuideInput& input);
    /// The guidance of the latest step; null: there is no visitor to guide, or nothing to correct.
    [[nodiscard]] const guidance::Guidance* guidance() const { return guidance_; }
    /// True while advice for the visitor who asked for help is being searched.
    [[nodiscard]] bool answers() const { return answers_; }
    /// Forgets the visitor, who has gone.
    void forget_visitor();
    /// Call before the artifact's hull goes: drops it, and the request for help.
    void drop_artifact();

private:
    [[nodiscard]] const guidance::Guidance* guide(MonotonicTime now, const VisitorGuideInput& input);
    [[nodiscard]] bool is_on_way_to_picture(MonotonicTime now, const VisitorGuideInput& input);

    Sensed sensed_;
    std::optional<guidance::Guide> guide_;
    const guidance::Guidance* guidance_ = nullptr;
    std::optional<MonotonicTime> way_since_; ///< since when the prop has been moving
    bool answers_ = false;
};

} // namespace frustumscreen::exhibit
