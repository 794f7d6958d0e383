#include "app/exhibit/hotspot_labels.h"

#include "app/geometry/inner_point.h"
#include "app/geometry/time_curves.h"
#include "app/settings/lit_zone.h"
#include "app/typography/visitor_side.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::exhibit {

namespace {

/// Cosine between the surface's normal and the direction to the eye, above which a label has full brightness.
constexpr double facing = 0.12;
/// More than any table extends behind a caption.
constexpr double behind_caption_m = 0.4;

Occluder occluder_of(const HotspotSet& set) {
    Occluder artifact{set.triangles.tree.get(), glm::dmat4(1.0 / set.metres_per_box),
                      set.triangles.tolerance_m};
    artifact.triangles_from_prop[3][3] = 1.0;
    return artifact;
}

/// 0 if the point faces away.
double brightness_facing(const Hotspot& hotspot, const glm::dvec3& eye_m) {
    const glm::dvec3 to_eye = eye_m - hotspot.point_m;
    const double distance = glm::length(to_eye);
    return distance > 0.0 ? geometry::ease(glm::dot(to_eye, hotspot.normal) / distance / facing) : 0.0;
}

/// The point of the table's plane that the eye sees behind the hotspot; the hotspot's own place if the eye is too low.
glm::dvec2 seen_on_table(const glm::dvec3& point_m, const glm::dvec3& eye_m) {
    if (!(point_m.z < 0.99 * eye_m.z)) {
        return point_m;
    }
    const double share = eye_m.z / (eye_m.z - std::max(0.0, point_m.z));
    return glm::dvec2(eye_m) + share * glm::dvec2(point_m - eye_m);
}

} // namespace

std::uint32_t faces_lit_from(const geometry::PropShape& prop, const glm::dvec3& lens_in_prop_m) {
    std::uint32_t lit = 0;
    for (std::size_t k = 0; k < prop.faces.size(); ++k) {
        const geometry::PropFace& face = prop.faces[k];
        const double distance = glm::distance(lens_in_prop_m, geometry::inner_point(face));
        lit |= face.plane.distance(lens_in_prop_m) >= settings::min_sine_of_light * distance ? 1U << k : 0U;
    }
    return lit;
}

std::optional<HotspotLabels::Key> HotspotLabels::wanted(const Input& input) {
    if (input.set == nullptr || !input.hotspot || *input.hotspot >= input.set->hotspots.size()) {
        return std::nullopt;
    }
    const std::vector<glm::dvec2>& sizes = input.set->hotspots[*input.hotspot].label_sizes_m;
    if (input.language >= sizes.size() || !(sizes[input.language].y > 0.0)) {
        return std::nullopt;
    }
    return Key{input.artifact, *input.hotspot, input.language};
}

void HotspotLabels::turn_to(const std::optional<Key>& key, const Input& input) {
    key_ = key;
    placer_.set_shapes(key ? std::span(&input.set->hotspots[key->hotspot].label_sizes_m[key->language], 1)
                           : std::span<const glm::dvec2>());
}

/// Excludes the area behind the caption, seen from the prop: no line leads past a caption, so a label has no place
/// there.
void HotspotLabels::keep_clear(const Input& input) {
    std::array<typography::TableRectangle, typography::CaptionPlacer::max_obstacles> obstacles{};
    std::size_t count = std::min(input.obstacles.size(), obstacles.size() - 1);
    std::copy_n(input.obstacles.begin(), count, obstacles.begin());
    if (input.caption) {
        typography::TableRectangle& behind = obstacles.at(count++);
        behind = *input.caption;
        const glm::dvec2 away = behind.centre_m - glm::dvec2(input.table_from_prop.translation);
        const glm::dvec2 seen = typography::turned(away, -behind.quarter_turns); // as the reader sees it
        const int axis = std::abs(seen.x) > std::abs(seen.y) ? 0 : 1;
        glm::dvec2 by(0.0);
        by[axis] = seen[axis] < 0.0 ? -0.5 * behind_caption_m : 0.5 * behind_caption_m;
        behind.centre_m += typography::turned(by, behind.quarter_turns);
        behind.size_m[axis] += behind_caption_m;
    }
    placer_.set_obstacles(std::span(obstacles).first(count));
}

std::optional<PresentedHotspot> HotspotLabels::step(MonotonicTime now, const Input& input) {
    const double passed = last_ ? to_seconds(now - *last_) / to_seconds(each_way) : 0.0;
    last_ = now;
    const std::optional<Key> goal = wanted(input);
    // Another artifact fades in with its own brightness, so the old label need not fade out.
    const bool other_artifact = key_ && input.artifact != key_->artifact;
    if (goal != key_ && (presence_ <= 0.0 || other_artifact)) {
        presence_ = 0.0;
        turn_to(goal, input);
    }
    changing_ = false;
    if (!key_) {
        return std::nullopt;
    }
    const LabelledHotspot& labelled = input.set->hotspots[key_->hotspot];
    const geometry::RigidTransform prop_from_table = input.table_from_prop.inverse();
    const glm::dvec3 eye_in_prop = prop_from_table.point(input.eye_m);
    const glm::dvec3 point_m = input.table_from_prop.point(labelled.at.point_m);
    const std::optional<typography::TablePolygon> shadow =
        typography::hidden_by_prop(*input.prop, input.table_from_prop, input.lens_m);
    const std::optional<typography::TablePolygon> hidden =
        typography::hidden_by_prop(*input.prop, input.table_from_prop, input.eye_m);
    keep_clear(input);
    placer_.update(now, shadow, hidden, seen_on_table(point_m, input.eye_m), input.quarter_turns);
    const typography::CaptionPlace place = placer_.at(now);

    PresentedHotspot shown{.artifact = key_->artifact,
                           .hotspot = key_->hotspot,
                           .language = key_->language,
                           .label = place.rectangle,
                           .line = {},
                           .brightness = 0.0};
    shown.line = leader_line({.point_m = point_m,
                              .eye_m = input.eye_m,
                              .shadow = shadow,
                              .hidden = hidden,
                              .label = place.rectangle,
                              .pictures = input.obstacles});
    const LitPlaces lit{faces_lit_from(*input.prop, prop_from_table.point(input.lens_m)), input.picture_edges,
                        input.table_from_prop};
    const bool seen = is_seen(labelled.at, eye_in_prop, *input.prop, lit, occluder_of(*input.set));
    const double presence_goal = goal == key_ && seen && shown.line ? 1.0 : 0.0;
    presence_ += std::clamp(presence_goal - presence_, -passed, passed);
    const double facing_eye = brightness_facing(labelled.at, eye_in_prop);
    changing_ = (presence_ != presence_goal && facing_eye > 0.0) ||
                (presence_ > 0.0 && place.opacity > 0.0 && place.opacity < 1.0);
    shown.brightness = geometry::ease(presence_) * facing_eye * place.opacity * input.brightness;
    return shown.brightness > 0.0 ? std::optional(shown) : std::nullopt;
}

} // namespace frustumscreen::exhibit
