/// The needs of a scene, decided before anything of it is loaded: a pure function of the settings, a pack's
/// outline and the possible views. Nothing outside the plan is read, compiled, allocated or opened.
///
/// The plan leaves out things by cull kind (`CullKind`), each with its reason. With or without them a scene
/// draws the same picture, pixel for pixel, at every pose that the plan was made for: the tests check this,
/// and `frustumscreen plan` measures the saving of each kind by drawing with and without it.
///
/// Decisions that need a level's own triangles follow level by level as they are read: scene_level.h.
///
/// Threads  pure; any.
/// Errors   a technique that the pack does not have; a pack's section that violates FORMAT.md.
#pragma once

#include "app/pack/pack_outline.h"
#include "app/pack/pack_relief.h"
#include "app/scene/error_estimate.h"
#include "app/scene/governor.h"
#include "app/scene/light.h"
#include "app/scene/shader_key.h"
#include "app/scene/visibility.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::scene {

/// True for a well-formed technique name: "auto", "finest", "relief", or "level" or "relief" and a number,
/// whether or not a pack has it; a relief's name may end in "-gpu".
inline constexpr std::string_view on_gpu_suffix = "-gpu";
[[nodiscard]] bool is_technique(std::string_view name);
/// "level0", "relief96", "relief96-gpu".
[[nodiscard]] std::string name_of(const QualityLevel& quality_level);
/// The way to draw for a technique's name, without its samples. "auto": the pack's default level; "finest";
/// "level0", "level1", ...; "relief96", "relief192", ...: by texels; "relief": the coarsest relief whose
/// texel is not clearly larger than a pixel of `pixel_box` on the prop, otherwise the finest. A relief is
/// rasterized on the processor; "relief-gpu", "relief96-gpu", ... are drawn by the GPU.
[[nodiscard]] Result<QualityLevel> quality_level_of(const pack::PackOutline& pack, std::string_view technique,
                                                    double pixel_box);

/// A cull kind: one kind of thing that a scene plan leaves out; bits.
enum CullKind : unsigned {
    UnusedLevels = 1,     ///< levels that neither the technique nor the governor can choose, and their
                          ///< textures
    UnusedCaptions = 2,   ///< texts, the typeface, the caption's pass
    UnusedShaders = 4,    ///< shaders that no draw names
    UnseenFaces = 8,      ///< faces of the prop that are never both seen and lit
    UnseenTriangles = 16, ///< triangles, and clusters of them, that always face away
    UnusedDetail = 32,    ///< mip levels finer than any pose needs; samples that no pose takes
    AllCullKinds = 63
};
[[nodiscard]] std::string_view name_of(CullKind cull_kind);

struct LeftOut {
    CullKind cull_kind = UnusedLevels;
    std::string what;
    std::string why;
};

/// The command line's additions to the settings.
struct SceneRequest {
    std::string technique = "auto";
    bool live = true; ///< the governor may choose among levels; otherwise a technique is one level
    /// The governor may also let the GPU draw a relief of up to this many blocks. 0 where the driver draws on
    /// the processor: there this program rasterizes them many times more quickly.
    std::uint32_t max_blocks_on_gpu = 0;
    bool light = true;
    int samples = 0; ///< a pixel; 0 = what the pack asks for
    /// Samples a pixel that the render target can hold wherever the prop stands; a smaller part of the picture
    /// may take more. Without headroom (1), and for pictures from poses, the target holds what the pack asks for.
    int sample_headroom = 1;
    unsigned cull_kinds = AllCullKinds;
    std::vector<std::size_t> captions; ///< of Pack::captions: those that a visitor can reach
    bool table_pictures = false;       ///< other artifacts lie on the table
    Visibility visibility;
    /// The scale of a cell, which its artifact places (cell_plan.h); nullopt: the largest size inside the prop.
    std::optional<double> metres_per_box = std::nullopt;
};

struct ScenePlan {
    std::vector<QualityLevel> quality_levels; ///< the quality levels of the artifact, best first
    std::vector<std::uint32_t> levels; ///< of the pack, to read and upload; those of `quality_levels` first
    std::vector<pack::ReliefOutline> reliefs; ///< of the pack, to read: those of `quality_levels`
    /// The level of the pack for exposure_of: the first of `levels`. If only reliefs are drawn, it is the pack's
    /// default level, which is read for this purpose but not uploaded, so that meshes and reliefs of one
    /// artifact are equally bright.
    std::uint32_t exposure_level = 0;
    std::vector<std::size_t> captions; ///< of the pack
    std::uint32_t faces = 0;           ///< of the prop, bits: those that may show
    /// As if all textures were opaque: an outline does not tell which of them have cut-out texels.
    RenderNeeds needs;
    unsigned cull_kinds = AllCullKinds;
    std::vector<LeftOut> left_out;
    // Inputs for the rest of the plan: scene_level.h.
    geometry::Pinhole projector; ///< in the pixels of one eye's picture
    std::size_t eyes = 1;        ///< pictures in each frame: scene/stereo.h
    geometry::RigidTransform table_from_projector;
    geometry::PropShape prop;
    double metres_per_box = 0.0;
    std::vector<SeenLevel> seen;         ///< of each of the pack's levels
    std::vector<SeenLevel> seen_reliefs; ///< of each of `reliefs`
    Visibility visibility;
    std::optional<LightCompensation> light; ///< nullopt: not requested
    int highlight_code = 0;                 ///< for exposure_of; 0 without light
};

[[nodiscard]] Result<ScenePlan> plan_scene(const settings::Settings& settings, const pack::PackOutline& pack,
                                           const SceneRequest& request);

} // namespace frustumscreen::scene
