/// One artifact on the display: its levels in memory, the governor that chooses one, and the fade from one to
/// the next.
///
/// Only the levels of the scene plan are uploaded. A change of level fades over `level_fade_s`, pixel by
/// pixel. A change of samples alone does not fade: on each of six scans, at each step, it altered the picture
/// less than moving the prop by a quarter of a pixel did (RMSE 3 to 69 codes against 5 to 83), and a governor
/// only decides while pictures change.
///
/// Threads  the render thread, with the display's context current. `draw` and `record_time` allocate nothing.
/// Errors   a technique that the pack does not have; a driver without memory.
#pragma once

#include "app/pack/pack_file.h"
#include "app/render/renderer.h"
#include "app/residency/read_layer.h"
#include "app/scene/error_estimate.h"
#include "app/scene/frame_plan.h"
#include "app/scene/governor.h"
#include "app/scene/level_data.h"
#include "app/scene/scene_level.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::residency {

inline constexpr double level_fade_s = 0.4;

/// A mesh level and the parts of it that the scene kept, or a relief; for reports.
struct LevelUse {
    std::uint32_t level = 0; ///< index into Pack::levels; for a relief, its texels
    std::size_t triangles = 0;
    std::size_t unseen_triangles = 0, unseen_clusters = 0;
    glm::ivec2 texture{0, 0}; ///< texels of the finest mip level kept
    int finest_mip = 0;
    std::uint64_t planned_gpu_bytes = 0;
    std::uint64_t gpu_bytes = 0; ///< as the driver reports; of a texture that levels share, the first one's
    std::size_t blocks = 0;      ///< of a relief, for which only the fields of GPU memory above apply;
                                 ///< otherwise 0
    bool on_gpu = false;         ///< the GPU draws the relief
    bool shares_texture = false; ///< with a level before it, which has its bytes
};

/// The level that is being drawn.
struct LevelState {
    std::string_view technique; ///< as requested
    std::string_view
        level; ///< a string literal, "level0", "relief96-gpu", ...; during a fade the incoming level
    int samples = 0;
    /// Error of the last frame drawn; during a fade the larger of the two levels' errors. nullopt: the
    /// artifact does not show.
    std::optional<scene::ErrorEstimate> error;
    std::uint64_t switches = 0;
    std::uint64_t ignored_times = 0;
};

/// A level after reading and culling, and its data to upload; or a level that is read later, without triangles and data.
struct PreparedLevel {
    LevelUse use; ///< `gpu_bytes` is not known yet
    scene::SeenLevel seen;
    glm::dvec3 box_size{1.0};
    int samples = 0; ///< Pack::samples
    /// Null for a relief, which is in `data`, and for a level that is read later.
    std::shared_ptr<const scene::LevelTriangles> triangles;
    scene::RenderNeeds needs;
    std::vector<scene::LeftOut> left_out;
    scene::LevelData data;
    std::size_t texture = 0; ///< of the pack; not for a relief
    /// The largest enlargement, relative to the plan, at which the kept mip levels show as much as the whole texture.
    double sharp_to = std::numeric_limits<double>::infinity();
};
/// `level`: one of the plan's. `before`: other levels of the pack, uploaded before it, whose texture it shares if it can
/// (LevelData::texture_of, an index into `before`). `max_samples_per_box`: samples of the picture along a box unit; mip levels
/// finer than that are left out. Pure; slow.
[[nodiscard]] PreparedLevel
prepare_level(const pack::Pack& pack, std::uint32_t level, const scene::ScenePlan& plan,
              std::span<const PreparedLevel> before = {},
              double max_samples_per_box = std::numeric_limits<double>::infinity());
/// Sets `use.gpu_bytes` to the bytes of the store that a level takes.
void note_gpu_bytes(const render::GpuStore& store, const scene::Drawable& drawable, LevelUse& use);
/// True if a quality level of the plan draws the relief with index `place` in this way.
[[nodiscard]] bool draws_relief(const scene::ScenePlan& plan, std::size_t place, bool on_gpu);
/// `place`: index into the plan's reliefs; `relief`: its data; `on_gpu`: the GPU draws it.
[[nodiscard]] PreparedLevel prepare_relief(const pack::PackDescription& pack, std::size_t place,
                                           std::shared_ptr<const relief::BlockRelief> relief, bool on_gpu,
                                           const scene::ScenePlan& plan);

class RunLevels {
public:
    static constexpr std::size_t max_marks = 1, max_mark_indices = 1000;

    /// The plan's levels in its order, then its reliefs, once for each way that a quality level draws them.
    /// Drawing requires a drawable for each. Needs no context.
    RunLevels(std::string technique, const scene::ScenePlan& plan, double deadline_ms,
              std::span<const PreparedLevel> levels);
    /// Sets the drawable of the level with index `place`, which is in the store.
    void give(std::size_t place, const scene::Drawable& drawable, const render::GpuStore& store);

    /// Gives the levels the layer's textures, and the reliefs its colours. All levels must have been given.
    [[nodiscard]] Result<void> add_layer(render::GpuStore& store, const ReadLayer& layer);

    /// Prepares and uploads all levels at once. `technique`: as requested. `pack` need not outlive the call.
    /// On failure nothing stays in the store.
    [[nodiscard]] static Result<RunLevels> upload(const pack::Pack& pack, const scene::ScenePlan& plan,
                                                  std::string technique, double deadline_ms,
                                                  render::GpuStore& store);
    /// Removes all given levels from the store; drawing is then impossible.
    void release(render::GpuStore& store);

    [[nodiscard]] const std::vector<LevelUse>& uses() const { return uses_; }
    [[nodiscard]] const std::vector<scene::LeftOut>& left_out() const { return left_out_; }
    /// The needs of a renderer for this artifact.
    [[nodiscard]] const scene::RenderNeeds& needs() const { return needs_; }

    /// Draws every quality level two to seven times for the view, fewer if a frame takes long; if frames are
    /// quick, repeats this, and starts the governor with the smaller of the two medians. Afterwards `target`
    /// holds an arbitrary picture, which must not be presented.
    void measure(const geometry::PropShape& prop, std::span<const scene::PlanView> views,
                 render::Renderer& renderer, const render::RenderTarget& target);

    /// Starts the governor with measured times: one for each quality level, best first.
    void start(const std::vector<scene::QualityLevelTime>& times);
    /// Starts the governor with predicted times for the view, for each eye. Needs no context.
    void start(const scene::FrameCost& cost, const geometry::PropShape& prop, const scene::PlanView& view);
    /// The times at the start; empty before.
    [[nodiscard]] const std::vector<scene::QualityLevelTime>& times() const { return times_; }

    /// GPU memory and main memory, by the plan.
    [[nodiscard]] std::uint64_t bytes() const;

    /// Call when the artifact comes on show while the GPU is under `load` (see Governor).
    void enter(MonotonicTime now, double load);
    [[nodiscard]] double load() const { return governor_.load(); }

    /// `views`: one for each eye of the scene plan. `marks`: polygons drawn with the level, at most `max_marks` of
    /// `max_mark_indices` together; their error does not count.
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const geometry::PropShape& prop,
                                          std::span<const scene::PlanView> views, render::Renderer& renderer,
                                          const render::RenderTarget& target, render::Redraw redraw,
                                          std::span<const scene::Part> marks = {});
    /// The plan of each eye's picture, to lend it space for windows.
    [[nodiscard]] std::span<scene::FramePlan> plans() { return plans_; }
    /// The level that `draw` draws, without its fade.
    [[nodiscard]] scene::PlacedLevel shown() const { return placed(shown_); }
    /// Its name among the pack's levels and reliefs.
    [[nodiscard]] const scene::QualityLevel& shown_quality() const { return levels_[shown_].shows; }
    /// A mesh about as exact as the drawn level, in a layer's colours. None: there is no mesh, or the layer is not loaded.
    [[nodiscard]] std::optional<scene::PlacedLevel> in_layer(std::size_t layer) const;
    /// Records that the latest `draw` took `ms` until its picture was complete.
    void record_time(MonotonicTime now, double ms);
    /// True while one level fades into another.
    [[nodiscard]] bool fades() const { return coming_.has_value(); }

    [[nodiscard]] LevelState state() const;

private:
    struct Level {
        scene::QualityLevel shows; ///< without samples
        scene::SeenLevel seen;
        scene::PlacedLevel placed;
    };
    /// The level with the samples that the governor chose.
    [[nodiscard]] scene::PlacedLevel placed(std::size_t slot) const;
    void plan(const geometry::PropShape& prop, std::span<const scene::Part> parts,
              std::span<const scene::PlanView> views);
    /// Error of the planned frame: the larger of the eyes'.
    [[nodiscard]] std::optional<scene::ErrorEstimate> estimate(const geometry::PropShape& prop,
                                                               std::span<const scene::PlanView> views) const;
    [[nodiscard]] std::size_t slot_of(const scene::QualityLevel& quality_level) const;
    /// The planned frame's work, at this quality level.
    [[nodiscard]] scene::FrameWork work(const scene::QualityLevel& quality_level) const;
    [[nodiscard]] double median_ms(const scene::QualityLevel& quality_level, const geometry::PropShape& prop,
                                   std::span<const scene::PlanView> views, render::Renderer& renderer,
                                   const render::RenderTarget& target);

    std::string technique_;
    std::vector<LevelUse> uses_;
    std::vector<scene::LeftOut> left_out_;
    scene::RenderNeeds needs_;
    std::vector<Level> levels_;
    std::vector<scene::QualityLevel> quality_levels_;
    std::vector<scene::QualityLevelTime> times_;
    double deadline_ms_;
    scene::Governor governor_;
    std::vector<scene::FramePlan> plans_; ///< one for each eye
    std::vector<scene::Part> parts_;      ///< of this frame
    std::size_t shown_ = 0;               ///< index into `levels_`
    std::optional<std::size_t> coming_;
    std::optional<scene::ErrorEstimate> error_;
    MonotonicTime fade_start_;
};

} // namespace frustumscreen::residency
