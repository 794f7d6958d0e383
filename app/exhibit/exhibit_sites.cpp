// A site in the prop: which region the button goes to.
#include "app/exhibit/exhibit.h"
#include "app/exhibit/site_places.h"

namespace frustumscreen::exhibit {

/// The pointing ray: the held torch's beam; without a torch, the eye's ray to the prop's middle.
SiteTravel::Ray Exhibit::pointer(const tracking::TrackedState& tracked_state, const DrawnPose& drawn,
                                 const Presentation& presentation) const {
    const geometry::RigidTransform prop_from_table = drawn.table_from_prop.inverse();
    for (const PresentedLight& light : presentation.torches.lights()) {
        if (!light.left && light.brightness > 0.0) {
            const geometry::RigidTransform prop_from_torch = prop_from_table * light.table_from_torch;
            return {prop_from_torch.translation,
                    prop_from_torch.point({0.0, 0.0, 1.0}) - prop_from_torch.translation};
        }
    }
    const glm::dvec3 eye = prop_from_table.point(tracked_state.eye_m);
    return {eye, place_.prop.middle - eye};
}

void Exhibit::travel(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                     const DrawnPose& drawn, Presentation& presentation) {
    const SiteGround* const site = catalogue_.site(shown.artifact);
    presentation.site = site_.step(now, {.site = site,
                                         .artifact = shown.artifact,
                                         .shown = has_artifact() && note_of(state_).artifact &&
                                                  !leaves_set() && catalogue_.ready(shown.artifact),
                                         .attracts = state_ == State::Attract,
                                         .pressed = site != nullptr && presses_.take_behaviour(),
                                         .towards = pointer(tracked_state, drawn, presentation)});
}

void Exhibit::place_map(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                        const DrawnPose& drawn, Presentation& presentation) {
    BehaviourTitle::Input input;
    input.size_m = glm::dvec2(site_map_m);
    input.light = shown.caption_brightness * drawn.brightness;
    if (presentation.site.view && !drawn.attracts) {
        input.title = TitleIndex{.artifact = shown.artifact, .behaviour = site_map_title, .language = 0};
    } else if (presentation.site.marked && windows_ && !drawn.attracts) {
        input.title = TitleIndex{.artifact = shown.artifact,
                                 .behaviour = site_preview_title + *presentation.site.marked,
                                 .language = 0};
        input.size_m = place_.windows->size_m;
    }
    Obstacles obstacles = obstacles_of(presentation);
    if (presentation.title) {
        obstacles.add(presentation.title->rectangle);
    }
    if (presentation.advice) {
        obstacles.add(presentation.advice->rectangle);
    }
    input.obstacles = obstacles.all();
    if (input.title || map_.has_title()) {
        input.environment = environment_of(place_, drawn, tracked_state.eye_m, side_.quarter_turns());
    }
    presentation.site_map = map_.step(now, input);
}

} // namespace frustumscreen::exhibit
