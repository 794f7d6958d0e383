/// The prop's faces that a visitor sees, those that the projector lights, and whether the artifact is seen whole.
///
/// Seen     the eye is in front of the face's plane by a sine of at least `min_sine_of_sight` at every corner.
/// Lit      the projector is in front of the plane by `min_sine_of_light` at every corner, and all corners lie in
///          its picture.
/// Valid    every seen face is lit. The prop is convex, so no face hides or shades another.
/// Whole    every place of the seen faces through which the artifact is seen (seen_places.h) is lit: the projector is
///          in front of the face by `min_sine_of_light`, and the place lies in its picture. Without a known
///          artifact: as Valid.
/// Stereo   each of the two eyes has its own picture: a face is seen if either eye sees it, and a situation is valid or
///          whole if it is for both. Areas that are unlit or lost are the mean of both eyes'.
///
/// Frames   table T, metres.
/// Threads  pure; any. Allocates nothing.
/// Source   Kim, Shin, Kim 2008, 'Guiding the user'.
#pragma once

#include "app/geometry/picture_planes.h"
#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::guidance {

/// The environment of guidance: the prop, its light and its space to move.
struct GuidanceSetup {
    geometry::PropShape prop;
    geometry::Pinhole projector;
    geometry::RigidTransform table_from_projector;
    double min_sine_of_light = 0.035;
    bool in_hand = false; ///< false: the prop stands on the table, whose edges limit its way
    glm::dvec2 half_table_m{0.4, 0.25};
    bool head_tracked = true;   ///< false: visitors are not asked to walk
    double interocular_m = 0.0; ///< stereo: distance between the eyes; 0: one eye
    /// The corners of the hull of the artifact in the prop, prop frame, at most 1024; empty: unknown.
    std::vector<glm::dvec3> hull{};
};

struct GuidedState {
    geometry::RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.0}; ///< between the visitor's eyes
    /// Stereo: from `eye_m` to the right eye; the left one is as far to the other side. Zero: one eye.
    glm::dvec3 to_right_eye_m{0.0};

    [[nodiscard]] bool has_two_eyes() const { return to_right_eye_m != glm::dvec3(0.0); }
};

/// Sets of faces: bit k is face k of the prop.
struct FaceSets {
    std::uint32_t seen = 0;
    std::uint32_t lit = 0;

    [[nodiscard]] std::uint32_t unlit() const { return seen & ~lit; }
    [[nodiscard]] bool valid() const { return unlit() == 0; }
};

class FaceReader {
public:
    static constexpr double min_sine_of_sight = 1e-3;
    static constexpr double pixels_per_radian = 1000.0;

    /// The prop has at most 32 faces.
    explicit FaceReader(GuidanceSetup setup);

    [[nodiscard]] const GuidanceSetup& setup() const { return setup_; }
    /// Replaces the set-up's artifact. The caller keeps the corners.
    void show(std::span<const glm::dvec3> hull) { shown_ = hull; }
    [[nodiscard]] std::span<const glm::dvec3> shown() const {
        return shown_.value_or(std::span<const glm::dvec3>(setup_.hull));
    }

    [[nodiscard]] FaceSets read(const GuidedState& tracked_state) const;
    /// As `read(situation).valid()`, but faster.
    [[nodiscard]] bool valid(const GuidedState& tracked_state) const;
    [[nodiscard]] bool whole(const GuidedState& tracked_state) const;
    /// True if the artifact is whole and there is a picture: a prop lying on the table with none of its faces seen
    /// shows nothing. `faces`: of the situation.
    [[nodiscard]] bool shows_whole(const GuidedState& tracked_state, const FaceSets& faces) const {
        return (faces.valid() || (!shown().empty() && whole(tracked_state))) &&
               (faces.seen != 0 || setup_.in_hand);
    }
    /// Area of these faces, in square pixels, in the picture of a pinhole at `eye_m` that looks at the prop's middle.
    [[nodiscard]] double area_px(const GuidedState& tracked_state, std::uint32_t faces) const;
    /// Area of the seen faces that are not lit.
    [[nodiscard]] double unlit_px(const GuidedState& tracked_state) const;
    /// Area of the places that prevent `whole`.
    [[nodiscard]] double lost_px(const GuidedState& tracked_state) const;
    /// The face of the set with the largest area, as a set; 0 for the empty set.
    [[nodiscard]] std::uint32_t largest_of(const GuidedState& tracked_state, std::uint32_t faces) const;

private:
    GuidanceSetup setup_;
    geometry::RigidTransform projector_from_table_;
    std::array<geometry::Plane, 4> picture_; ///< projector's frame
    std::optional<std::span<const glm::dvec3>> shown_;
};

} // namespace frustumscreen::guidance
