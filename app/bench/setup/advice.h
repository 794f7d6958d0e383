/// Chooses a prop and a place of the projector for a table: the figures of each choice, and the best of many.
///
/// Frames   table T, metres. Light as light_range.h.
/// Threads  pure; any.
/// Errors   none: a choice that cannot work has figures that show it.
#pragma once

#include "app/bench/setup/frame_cost.h"
#include "app/settings/light_range.h"
#include "app/settings/settings.h"

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

/// The figures of a set-up for a visitor. They assume two upright bodies as artifacts, each as large as fits into the
/// prop: one as wide as high, one half as wide as high.
struct SetUpFigures {
    settings::LightRange light;
    double reference = 0.0; ///< light that every place can send back: even_light
    glm::dvec2 reach_m{0.0};
    double wide_height_m = 0.0; ///< height of the artifact that is as wide as high
    double slim_height_m = 0.0; ///< height of the artifact that is half as wide as high
    /// Projector pixels that show an ellipsoid as large as the slim artifact, with the prop at the table's middle, seen
    /// by the default eye: the mean over the prop turned by 0 and 45 degrees.
    double pixels = 0.0;
    double usual_height_m = 0.0; ///< height of the zone's artifact: usual_artifact
    glm::dvec2 zone_m{0.0};      ///< width and depth of the zone in which all eyes see it whole, at any yaw
    bool covered = false;        ///< the picture covers the table and the prop at every place
};
[[nodiscard]] SetUpFigures examine(const settings::Settings& settings);

/// The way to place the lens beside the table's middle: tilt the projector, or shift its lens.
enum class Mount { Tilted, Shifted };
[[nodiscard]] std::string_view name_of(Mount mount);

struct SetUpChoice {
    settings::Settings settings;
    Mount mount = Mount::Tilted;
    SetUpFigures figures;
    /// True if the light is even enough, the table covered, the pixels enough, and the artifacts no smaller than at
    /// present.
    bool works = false;
    std::optional<SetUpCost> cost; ///< nothing if it was not measured
};
/// The present settings, for comparison.
[[nodiscard]] SetUpChoice as_it_is(const settings::Settings& settings);

struct AdviceOptions {
    double lowest_m = 1.0; ///< height of the lens above the table
    double highest_m = 1.6;
    double evenness = 0.35;    ///< least evenness of a choice that works
    double sides_m = 0.3;      ///< largest distance of the lens behind or in front of the table's middle
    int width = 0, height = 0; ///< picture's size in pixels; 0: the present one
    double pixels = 1.0;       ///< least pixels on the artifact, as a multiple of the present
    /// Least width and depth of the zone of a choice that works, for an artifact of at least `artifact_m`. Artifacts
    /// may then be smaller than at present, and the picture may extend beyond the table. 0: no zone is required.
    glm::dvec2 zone_m{0.0};
    double artifact_m = 0.12;
    [[nodiscard]] bool asks_for_zone() const { return zone_m.x > 0.0 || zone_m.y > 0.0; }
};
/// For each height and side of the lens and each mount (and each width of the picture, if a zone is required): the
/// smallest prop that works, because it can be slid farthest, and of equally large ones the one with most light; if
/// none works, the one whose light is most even. The projector's picture just covers the table. `settings` has the
/// table, the eyes and the figures to improve on. `progress`: 0..1.
[[nodiscard]] std::vector<SetUpChoice> choices(const settings::Settings& settings,
                                               const AdviceOptions& options,
                                               const std::function<void(double)>& progress);
/// The choice that works with the most space to slide, times brightness; otherwise the most even one. Null if there is
/// none.
[[nodiscard]] const SetUpChoice* best_of(const std::vector<SetUpChoice>& choices);

/// The best choices that work, at most `most`, best first.
[[nodiscard]] std::vector<SetUpChoice*> best_working(std::vector<SetUpChoice>& choices, std::size_t most);

} // namespace frustumscreen::bench
