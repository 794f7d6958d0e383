/// Which prop and which place of the projector suit a table: what each choice gives, and the best of many.
///
/// Frames   table T, metres. Light as light_range.h.
/// Threads  pure; any.
/// Errors   none: a choice that cannot work says so in its figures.
#pragma once

#include "app/bench/setup/frame_cost.h"
#include "app/settings/light_range.h"
#include "app/settings/settings.h"

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// What a visitor gets from a set-up. The artifacts are two upright bodies, as large as fit into the prop: one as wide as
/// high, one half as wide as high.
struct SetUpFigures {
    LightRange light;
    double reference = 0.0; ///< what every place sends back: even_light
    glm::dvec2 reach_m{0.0};
    double wide_height_m = 0.0; ///< of the artifact as wide as high
    double slim_height_m = 0.0; ///< of the one half as wide
    /// Projector pixels that show an ellipsoid as large as the slim artifact, prop at the table's middle: the mean over the
    /// prop turned by 0 and 45 degrees, seen by the default eye.
    double pixels = 0.0;
    double usual_height_m = 0.0; ///< of the artifact that the zone is for: usual_artifact
    glm::dvec2 zone_m{0.0}; ///< where it is seen whole by all eyes, at any yaw: the zone's width and depth
    bool covered = false;   ///< the picture covers the table and the prop wherever it stands
};
[[nodiscard]] SetUpFigures examine(const Settings& settings);

/// How the lens comes to lie beside the table's middle: the projector is tilted, or its lens shifted.
enum class Mount { Tilted, Shifted };
[[nodiscard]] std::string_view name_of(Mount mount);

struct SetUpChoice {
    Settings settings;
    Mount mount = Mount::Tilted;
    SetUpFigures figures;
    /// Even enough, covered, with pixels enough; its artifacts are no smaller than they are now.
    bool works = false;
    std::optional<SetUpCost> cost; ///< if it was measured
};
/// The settings as they are, to compare with.
[[nodiscard]] SetUpChoice as_it_is(const Settings& settings);

struct AdviceOptions {
    double lowest_m = 1.0; ///< of the lens above the table
    double highest_m = 1.6;
    double evenness = 0.35;    ///< the least that works
    double sides_m = 0.3;      ///< the lens may lie this far behind or before the table's middle
    int width = 0, height = 0; ///< of the picture, pixels; 0: as it is
    double pixels = 1.0;       ///< on the artifact, times as many as now: the least that works
    /// The least zone that works, width and depth, for an artifact of so many metres at least. Artifacts may then be smaller than they
    /// are, and the picture may reach out over the table. 0: no zone is asked for.
    glm::dvec2 zone_m{0.0};
    double artifact_m = 0.12;
    [[nodiscard]] bool asks_for_zone() const { return zone_m.x > 0.0 || zone_m.y > 0.0; }
};
/// For each height and side of the lens and each mount (and each width of the picture, where a zone is asked for) the smallest prop that works, because it can be slid farthest, and of
/// equally large ones the one with most light; where none works, the one whose light is most even. The projector's picture
/// just covers the table. `settings` has the table and the eyes, and says what is better than now. `progress`: 0..1.
[[nodiscard]] std::vector<SetUpChoice> choices(const Settings& settings, const AdviceOptions& options,
                                               const std::function<void(double)>& progress);
/// Of those that work the one with the most room to slide, times brightness; else the most even. Null if there is none.
[[nodiscard]] const SetUpChoice* best_of(const std::vector<SetUpChoice>& choices);

/// The best `most` of those that work, the best first.
[[nodiscard]] std::vector<SetUpChoice*> best_working(std::vector<SetUpChoice>& choices, std::size_t most);

} // namespace frustumscreen
