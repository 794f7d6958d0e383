/// One picture as plain data: what to draw on which face of the prop. The renderer decides nothing.
///
/// The pack meets the configuration here. A plan is a pure function of its inputs, in 64-bit until the last
/// step.
///
/// Frames   as named; clip coordinates as `Pinhole::clip_from_point`: y = -1 is the picture's top.
/// Units    metres, pixels.
/// Threads  pure; any. `plan_frame` allocates nothing into a plan that `make_plan` made for the same inputs.
/// Errors   none: an eye inside the prop, a prop off the picture or a face without light give an emptier
/// picture.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/pack/pack.h"
#include "app/scene/light.h"
#include "app/scene/lit_tiles.h"
#include "app/scene/visible_triangles.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

/// The artifact at one level, placed in the configured prop.
struct PlacedLevel {
    std::shared_ptr<const LevelTriangles> triangles; ///< none: nothing shows
    glm::dvec3 box_size{1.0};                        ///< extents of the pack's box
    double metres_per_box = 1.0;                     ///< Placement::metres_per_box
    std::uint64_t id = 0;                            ///< tells artifacts and levels apart in a plan's hash
    int samples = 0; ///< Pack::samples, or what a governor allows; 0 = as many as the renderer takes
    std::uint32_t faces = ~std::uint32_t{0}; ///< of the prop, bits: those that the artifact may show on
};
[[nodiscard]] PlacedLevel placed(const Pack& pack, std::uint32_t level, double metres_per_box,
                                 std::uint64_t id);

/// A picture that lies flat on the table: a caption. Table frame, metres.
struct TablePicture {
    std::array<glm::dvec3, 4> corners_m{}; ///< of the picture: top left, top right, bottom right, bottom left
    double brightness = 1.0;               ///< 0..1, linear light
    std::uint64_t id = 0;                  ///< tells pictures apart in a plan's hash
};

/// A second level of the artifact that is coming in: it draws a share of the pixels, the first level the
/// rest.
struct LevelFade {
    const LevelTriangles* triangles = nullptr;
    std::uint64_t id = 0; ///< as PlacedLevel::id
    double share = 0.0;   ///< 0..1
};

/// Where everything stands.
struct PlanView {
    Pinhole projector;
    RigidTransform table_from_projector;
    RigidTransform table_from_prop;
    /// Table frame. One eye for all faces, or one for each.
    std::span<const glm::dvec3> eyes_m;
    /// Nothing = colours leave as they are in the texture.
    std::optional<LightCompensation> light = LightCompensation{};
    double brightness = 1.0; ///< of the artifact, 0..1, linear light: fades; 0 leaves the prop dark
    std::optional<TablePicture> caption = std::nullopt;
    std::optional<LevelFade> fade = std::nullopt;
};

/// A run of FramePlan::indices.
struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// One face of the prop that is turned to its eye and lit by the projector.
struct FacePlan {
    int face = 0;                            ///< index into PropShape::faces
    glm::mat4 clip_from_unit{1.0F};          ///< PackVertex::position / 65535 -> clip
    std::array<glm::vec4, 4> corners_clip{}; ///< the face's outline; depth 0
    FaceLight light;
    IndexRange shown;            ///< of FramePlan::indices
    IndexRange coming;           ///< of the level that comes in, while one does
    PixelRectangle bounds;       ///< holds every pixel that the artifact can light on this face
    double pixels_per_box = 0.0; ///< along one box unit at the artifact's middle, across the eye's ray; the
                                 ///< mean of two directions, by area
};

/// A caption, and the outlines of the prop's lit faces, which it never lights.
struct CaptionPlan {
    std::array<glm::vec4, 4> corners_clip{};
    float brightness = 1.0F;
    PixelRectangle bounds; ///< empty = no caption
    std::vector<std::array<glm::vec4, 4>> prop_clip;
};

struct FramePlan {
    Pinhole projector;
    bool compensate_light = false;
    /// A pixel, of the artifact; 0 = as many as the renderer takes. Where a face is seen or lit so slantingly
    /// that few pixels show much of the artifact, each takes more samples than the level asked for: a place
    /// of the artifact keeps its samples, and the fewer pixels pay for them.
    int samples = 0;
    float brightness = 1.0F;
    /// Of the pixels, those that the level coming in draws; nothing = one level is drawn.
    std::optional<float> coming_share;
    std::vector<FacePlan> faces;
    std::vector<std::uint32_t> indices; ///< of the triangles that each face shows
    FrontTriangles front, coming_front; ///< of the eye planned for last
    LitTiles lit;                       ///< hold every pixel that the artifact can light
    CaptionPlan caption;
    glm::dvec3 prop_from_unit_scale{1.0}; ///< metres: prop point = scale * (position / 65535) + offset
    glm::dvec3 prop_from_unit_offset{0.0};
    std::uint64_t hash = 0; ///< equal for equal pictures (of one pack)
};

/// A plan with room for every face and `indices`: those of all levels that are drawn at one time.
[[nodiscard]] FramePlan make_plan(const PropShape& prop, std::size_t indices);
[[nodiscard]] FramePlan make_plan(const PropShape& prop, const PlacedLevel& artifact);

/// `artifact` without triangles: the prop stays dark.
void plan_frame(const PropShape& prop, const PlacedLevel& artifact, const PlanView& view, FramePlan& plan);

/// Every pixel that the plan can light.
[[nodiscard]] PixelRectangle lit_bounds(const FramePlan& plan);

} // namespace frustumscreen
