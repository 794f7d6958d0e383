/// One picture as plain data: a list of draws, on the faces of the prop and on the table. The renderer makes
/// no decisions.
///
/// The pack and the configuration are combined here. A plan is a pure function of its inputs, in 64-bit
/// arithmetic until the last step.
///
/// Frames   as named; clip coordinates as `Pinhole::clip_from_point`: y = -1 is the picture's top.
/// Units    metres, pixels.
/// Threads  pure; any. `plan_frame` allocates nothing into a plan that `make_plan` made for the same inputs.
/// Errors   none: an eye inside the prop, a prop outside the picture or a face without light give an emptier
///          picture.
#pragma once

#include "app/geometry/collineation.h"
#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/pack/pack.h"
#include "app/relief/block_relief.h"
#include "app/relief/dither.h"
#include "app/relief/raster_view.h"
#include "app/scene/drawable.h"
#include "app/scene/edge_feather.h"
#include "app/scene/light.h"
#include "app/scene/lit_tiles.h"
#include "app/scene/placed_torch.h"
#include "app/scene/shader_key.h"
#include "app/scene/visible_triangles.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::ldi {
struct PointPatch;
}

namespace frustumscreen::scene {

struct WindowPatches;

/// An artifact at one quality level, or a part of one, placed in the configured prop.
struct PlacedLevel {
    std::shared_ptr<const LevelTriangles> triangles; ///< null and no `relief`: nothing is drawn
    glm::dvec3 box_size{1.0};                        ///< extents of the pack's box
    double metres_per_box = 1.0;                     ///< Placement::metres_per_box
    Drawable drawable;
    int samples = 0; ///< Pack::samples, or the governor's choice; 0 = as many as the renderer takes
    std::uint32_t faces = ~std::uint32_t{0}; ///< of the prop, bits: the faces that it may show on
    std::shared_ptr<const relief::BlockRelief>
        relief{};        ///< drawn instead of the triangles; `drawable` names it
    bool on_gpu = false; ///< the GPU draws the relief; otherwise it is rasterized on
                         ///< the processor
    /// Moves the placed box inside the prop: a cell's pose (world/cell.h). An affine transform.
    glm::dmat4 prop_from_placed{1.0};
    glm::vec3 light{1.0F}; ///< factor of its colours, linear light, red, green and blue
    /// Drawn instead of the triangles, rasterized on the processor: points in the prop's frame, around which the box lies. They
    /// live as long as the frame's plan.
    const ldi::PointPatch* points = nullptr;
    /// The level reaches out of the prop: it is cut off at each face, and what lies behind the faces is drawn. Only
    /// for triangles; if one part does, all parts of a frame count as such.
    bool beyond = false;

    [[nodiscard]] bool is_empty() const { return !triangles && !relief && points == nullptr; }
    /// The bounds of its box as placed, before `prop_from_placed`.
    [[nodiscard]] geometry::Box placed_box() const {
        const glm::dvec3 extent = box_size * metres_per_box;
        return {{-0.5 * extent.x, -0.5 * extent.y, 0.0}, {0.5 * extent.x, 0.5 * extent.y, extent.z}};
    }
    [[nodiscard]] glm::dmat4 prop_from_box() const;
};
[[nodiscard]] PlacedLevel placed(const pack::Pack& pack, std::uint32_t level, double metres_per_box,
                                 const Drawable& drawable = {});

/// A relief at one resolution, in the renderer's store under `drawable`.
[[nodiscard]] PlacedLevel placed(const pack::Pack& pack, std::shared_ptr<const relief::BlockRelief> relief,
                                 double metres_per_box, const Drawable& drawable);

using relief::Dither;

/// A level to draw in the prop.
struct Part {
    PlacedLevel level;
    std::optional<Dither> dither; ///< nullopt: every pixel. Of points: their share of each pixel's light
};
/// A fade from one level to another. `share`: of the pixels that show `to`, 0..1.
[[nodiscard]] std::array<Part, 2> fade(const PlacedLevel& from, const PlacedLevel& to, double share);

/// A picture that lies flat on the table: a caption, a line, an artifact to choose. Table frame, metres.
struct TablePicture {
    std::array<glm::dvec3, 4> corners_m{}; ///< of the picture: top left, top right, bottom right, bottom left
    double brightness = 1.0;               ///< 0..1, linear light
    TextureId texture = TextureId::None;
    bool on_prop = false; ///< drawn on the prop too; otherwise the prop covers it
};

/// A flat surface that lies apart from the prop, through which another world is seen: a pinned window.
struct PlacedWindow {
    /// One face, in the window's frame: it lies in z = 0 and looks up.
    const geometry::PropShape* surface = nullptr;
    geometry::RigidTransform table_from_window;
    /// The world behind it, placed in the window's frame as a prop's world is in the prop's.
    std::span<const Part> parts;
    double brightness = 1.0; ///< as PlanView::brightness
    /// Points that eyes see of the parts, drawn in their place where they are ready (window_patches.h); null: none are.
    const WindowPatches* patches = nullptr;
    /// Torches that light the parts, table frame; then no points are drawn. Only in a plan whose windows have space
    /// for them.
    std::span<const PlacedTorch> torches = {};
};

/// The part of the display's picture that holds one eye's picture.
struct EyePicture {
    /// In the display's picture, of the size of the eye's pinhole; empty: the whole picture.
    PixelRectangle viewport{};
    /// Red, green and blue that this eye sees.
    glm::bvec3 channels{true};

    [[nodiscard]] bool operator==(const EyePicture&) const = default;
};

/// The poses of projector and prop, the eye, and the light of one eye's picture of a frame.
struct PlanView {
    geometry::Pinhole projector; ///< in the pixels of the eye's picture
    geometry::RigidTransform table_from_projector;
    geometry::RigidTransform table_from_prop;
    /// Table frame. One eye for all faces, or one per face.
    std::span<const glm::dvec3> eyes_m;
    /// nullopt: colours stay as they are in the texture.
    std::optional<LightCompensation> light = std::nullopt;
    /// Factor of the artifact's linear light: fades and exposure; 0 leaves the prop dark. Above 1, values
    /// beyond the projector's maximum are clipped.
    double brightness = 1.0;
    std::optional<TablePicture> caption = std::nullopt;
    std::span<const TablePicture> on_table = {}; ///< drawn before the caption, at most max_on_table
    EyePicture picture = {};
    /// Table frame. The eyes that decide together how far the artifact dims; empty: `eyes_m`.
    std::span<const glm::dvec3> dimming_eyes_m = {};
    /// Torches that light what is in the prop, in this order; at most torch::max_torches. Only in a plan that has
    /// space for them.
    std::span<const PlacedTorch> torches = {};
    /// Only in a plan that has space for them. They share the prop's light compensation and eyes, and have torches of
    /// their own.
    std::span<const PlacedWindow> windows = {};
};
/// Enough for a page of pictures with their titles, the ring around the prop, a hotspot, the zone's frame,
/// signs and words, a notice and its ring.
inline constexpr std::size_t max_on_table = 96;
/// Enough for those of the settings.
inline constexpr std::size_t max_windows = settings::max_windows;

/// A run of FramePlan::indices.
struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// One face of the prop that is turned to its eye and lit by the projector.
struct FacePlan {
    int face = 0;                                  ///< index into PropShape::faces
    geometry::PerCorner<glm::vec4> corners_clip{}; ///< the face's outline; depth 0
    FaceLight light;
    PixelRectangle bounds; ///< around the bounds of its draws
    /// At the artifact's middle, perpendicular to the eye's ray; the mean of two directions, by area.
    double pixels_per_m = 0.0;
    /// Depth of its draws in normalised device coordinates: dot(xyz, L) r + w, for the light's ray L = (x, y, 1) in the
    /// projector's frame and the nearness r (relief/nearness_row.h).
    glm::vec4 depth_from_nearness{0.0F};
};

/// A relief as the frame's eye sees it, to be rasterized into a picture in main memory or drawn by the GPU.
struct ReliefDraw {
    MeshId relief = MeshId::None; ///< in the renderer's store
    bool on_gpu = false;
    relief::RasterView view;
    glm::dmat4 prop_from_box{1.0};
    glm::vec3 light{1.0F};                   ///< PlacedLevel::light
    std::optional<Dither> dither;            ///< Part::dither
    int samples = 1;                         ///< a pixel
    bool even_light = false;                 ///< evens out the projector's light
    const ldi::PointPatch* points = nullptr; ///< PlacedLevel::points, in place of the relief
};

/// A mesh or a relief seen through one face of the prop, a relief's rasterized picture there, or a
/// quadrilateral on the table.
struct Draw {
    static constexpr int on_table = -1;

    ShaderKey shader;
    Drawable drawable;   ///< no mesh: a quadrilateral; no texture: black
    int face = on_table; ///< index into FramePlan::faces
    /// PackVertex::position / 65535 -> clip. A quadrilateral's columns are its corners, depth 0: top left,
    /// top right, bottom right, bottom left of its picture.
    glm::mat4 clip_from_unit{1.0F};
    glm::dmat4 clip_from_box{1.0};    ///< for a relief drawn by the GPU, for its grids
    glm::dmat4 clip_from_placed{1.0}; ///< PlacedLevel::placed_box -> clip
    std::size_t part = 0;             ///< index into the frame's parts, in the prop
    glm::mat4 prop_from_unit{1.0F};   ///< PackVertex::position / 65535 -> metres
    IndexRange range;
    PixelRectangle bounds;       ///< contains every pixel that it can light
    double pixels_per_box = 0.0; ///< as FacePlan::pixels_per_m, in box units at the mesh's middle
    float brightness = 1.0F;     ///< linear light
    glm::vec3 light{1.0F};       ///< PlacedLevel::light
    Dither dither;               ///< used if the shader dithers
    std::size_t relief_draw = 0; ///< for a relief: index into FramePlan::relief_draws
};

/// A torch's light on what the plan draws, for the shader.
struct TorchLight {
    glm::dmat4 torch_from_prop{1.0}; ///< metres; torch.h
    glm::mat4 torch_from_projector{1.0F};
    glm::vec3 eye{0.0F}; ///< torch's frame: the first eye, for reliefs that are rasterized on the processor
    glm::vec2 per_half_extent{1.0F}; ///< x / z times this is -1..1 in the content
    /// In the torch's own picture 1 / z is x times the depth, 0..1, and y; or of a relief's nearness (relief/nearness_row.h).
    glm::vec2 inverse_z_of_depth{0.0F}, inverse_z_of_nearness{0.0F};
    float reach_m = 0.0F;
    /// Torch's frame: the half space a.X + d >= 0 in which a world that reaches out of the prop casts shadows; zero: all of it does.
    glm::dvec4 casting{0.0};
    PlacedTorch torch;
};
/// A draw in the prop that a torch lights, in whole or in part.
struct TorchDraw {
    std::size_t draw = 0, torch = 0; ///< indices into FramePlan::draws, FramePlan::torches
    PixelRectangle bounds;           ///< contains every pixel that it lights
    IndexRange range;                ///< of a mesh that shows a layer: the triangles that meet the beam
};
/// A torch's light on a face of the prop.
struct TorchFace {
    std::size_t torch = 0,
                draw =
                    0; ///< indices into FramePlan::torches, FramePlan::draws: one of the draws that it lights
    int face = 0;      ///< index into FramePlan::faces
    LitTiles lit;      ///< contain every pixel that it lights there
    /// Torch's frame: the place at depth z, in normalised device coordinates, along the ideal ray (x, y, 1) is eye +
    /// from_ray (x, y, 1) / (z - end_of_depth . (x, y, 1)).
    glm::mat3 from_ray{0.0F};
    glm::vec3 eye{0.0F};
    glm::vec3 end_of_depth{0.0F}; ///< (0, 0, z) but for a world that reaches out of the prop
};
/// Pixels along each side of the torch's own picture, in which its shadows are found.
inline constexpr int torch_picture_px = 512;

struct FramePlan {
    geometry::Pinhole projector;
    EyePicture picture;
    /// Samples a pixel of the GPU's draws in the prop, 1 without any; 0 = as many as the renderer takes.
    /// Where a face is seen or lit so slantingly that few pixels show much of the artifact, each pixel takes
    /// more samples than the level asked for, so that each place of the artifact keeps its samples.
    int samples = 0;
    std::vector<FacePlan> faces;
    std::vector<EdgeFeather> feathers; ///< drawn after the draws in the prop
    std::vector<Draw> draws; ///< in the order of drawing: on the table, then part by part in the prop
    std::vector<std::uint32_t> indices; ///< of the triangles that the draws show
    LitTiles lit;                       ///< contain every pixel that the draws in the prop can light
    PixelRectangle prop_bounds;         ///< around the prop, also its dark parts
    std::uint64_t hash = 0;             ///< equal for equal pictures (of one renderer), windows included
    std::uint64_t prop_hash = 0;        ///< as `hash`, only for the draws in the prop
    FrontTriangles front;               ///< of the part and the eye planned last; not drawn
    std::vector<ReliefDraw>
        relief_draws; ///< one per part that may be a relief; the first `relief_draw_count` belong to the frame
    std::size_t relief_draw_count = 0;
    std::vector<TorchLight> torches;    ///< that may light some of the draws in the prop
    std::vector<TorchDraw> torch_draws; ///< torch by torch
    std::vector<TorchFace> torch_faces; ///< torch by torch
    /// The view of each of `torches`, for its shadows; the first ones, as many as there are torches, are the frame's.
    std::vector<FramePlan> torch_views;
    std::vector<Part> casters;   ///< the parts of a torch's own picture
    geometry::PropShape surface; ///< of a torch's own picture: the square that its light meets first
    /// The view in each window, drawn after all else; the first `window_count` are the frame's. One that shows nothing has
    /// no faces.
    std::vector<FramePlan> windows;
    std::size_t window_count = 0;
    /// In a window's plan: a convex polygon in the picture that the prop covers, with a margin; empty if it is beside the window.
    std::vector<glm::vec4> cover_clip;
};

/// A plan with space for every face of `parts` parts that have `indices` indices together. A plan for torches or
/// windows takes some more space (torch_plan.h, window_plan.h); without it none are planned.
[[nodiscard]] FramePlan make_plan(const geometry::PropShape& prop, std::size_t indices, std::size_t parts);
[[nodiscard]] FramePlan make_plan(const geometry::PropShape& prop, const PlacedLevel& artifact);

/// The first part that the GPU draws sets the samples a pixel; of the reliefs rasterized on the processor the one with
/// the most. With one eye per face a relief is drawn for the first eye.
void plan_frame(const geometry::PropShape& prop, std::span<const Part> parts, const PlanView& view,
                FramePlan& plan);
/// As above, for one part; without triangles the prop stays dark.
void plan_frame(const geometry::PropShape& prop, const PlacedLevel& artifact, const PlanView& view,
                FramePlan& plan);

/// Every pixel that the plan can light, in windows too.
[[nodiscard]] PixelRectangle lit_bounds(const FramePlan& plan);
/// Every pixel that the draws in the prop can light.
[[nodiscard]] PixelRectangle bounds_in_prop(const FramePlan& plan);

} // namespace frustumscreen::scene
