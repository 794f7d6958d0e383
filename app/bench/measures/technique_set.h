/// The techniques that one run compares: all on one stage, on one display of their own.
///
/// Threads  the one that opened it: the display's context is current there.
/// Errors   no display; whatever making a technique reports.
#pragma once

#include "app/bench/measures/measure.h"
#include "app/bench/measures/timing.h"
#include "app/bench/techniques/pack_level.h"
#include "app/bench/techniques/peer_choice.h"
#include "app/bench/techniques/peers.h"
#include "app/pack/pack_file.h"
#include "app/scene/governor.h"
#include "firmware_host/display/display.h"

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// Settings and the name that tables show.
struct SetUp {
    std::string name;
    Settings settings;
};

enum class TechniqueKind {
    Floor,
    PackLevel,
    PackRelief, ///< the pack's layered relief at one resolution; its count is of blocks
    Auto,       ///< the level that the exhibit's governor takes in this set-up while it is in time
    FullMesh,
    TwoPass,
    RayCast, ///< the method whose picture is the truth, as a peer
    Lod,
    TwoPassLod,
    Relief,     ///< relief images, marched or warped
    ReliefCast, ///< layered relief that the pack does not hold; its count is of blocks
    ReliefGpu,  ///< the pack's layered relief, drawn by the GPU; its count is of blocks
};
/// The name in tables and files.
[[nodiscard]] std::string_view name_of(TechniqueKind kind);

struct TechniqueResult {
    std::string name;
    TechniqueKind kind = TechniqueKind::PackLevel;
    int level = -1;       ///< PackLevel, Auto
    std::string drawn_as; ///< the surface whose rays tell where drawing puts the picture; empty: nobody asked
    std::uint64_t bytes = 0;          ///< of the pack's level or relief, in main memory; 0: not a pack's
    std::uint64_t triangles = 0;      ///< of what is drawn
    int samples = 1;                  ///< a pixel
    std::vector<PictureError> errors; ///< one for each pose; empty for the floor
    std::vector<std::optional<ErrorEstimate>> estimates; ///< what the exhibit says of each; nothing for peers
    ErrorSummary error;
    Spread time_ms;
    double times_floor = 0.0; ///< median / that of the faster floor
    double cpu_ms = 0.0;      ///< median, all threads
    double cpu_times_floor = 0.0;
};

class TechniqueSet {
public:
    /// Opens a set with the floors, one for each filter.
    [[nodiscard]] static Result<std::unique_ptr<TechniqueSet>> open(const SetUp& set_up);
    TechniqueSet(const TechniqueSet&) = delete;
    TechniqueSet& operator=(const TechniqueSet&) = delete;

    /// What the exhibit may take while it is in time: the mesh that is good enough, and the relief that is, if one is. It takes the quicker
    /// one of them, which it measures. The pack must outlive the set.
    [[nodiscard]] Result<void> add_auto(const Pack& pack, const PictureOptions& options);
    [[nodiscard]] Result<void> add_level(const Pack& pack, std::uint32_t level,
                                         const PictureOptions& options);
    /// `samples` here and below: a pixel; each peer is there once with each.
    [[nodiscard]] Result<void> add_peers(const SourceMesh& mesh, const glm::dmat4& prop_from_artifact,
                                         bool full_mesh, const std::vector<int>& two_pass_pixels,
                                         const std::vector<int>& samples = {1});
    [[nodiscard]] Result<void> add_ray_cast(const Truth& truth, const std::vector<int>& samples = {1});
    /// Adds the simplified source, drawn through the collineation and by two passes, as the choice says.
    [[nodiscard]] Result<void> add_levels_of_detail(const SourceMesh& mesh,
                                                    const glm::dmat4& prop_from_artifact,
                                                    const PeerChoice& choice);

    /// Adds peers that show relief images of `texels` a side.
    [[nodiscard]] Result<void> add_relief_peers(const Truth& truth, const SourceMesh& mesh,
                                                const glm::dmat4& prop_from_artifact, int texels);

    /// The pack's reliefs, one for each resolution that it has. The pack must outlive the set.
    [[nodiscard]] Result<void> add_reliefs(const Pack& pack, const PictureOptions& options);
    /// The one of them with the most texels.
    [[nodiscard]] Result<void> add_finest_relief(const Pack& pack, const PictureOptions& options);
    /// The same, drawn by the GPU.
    [[nodiscard]] Result<void> add_reliefs_on_gpu(const Pack& pack, const PictureOptions& options);
    /// Reliefs of other resolutions, made from the pack's finest level. The pack must outlive the set.
    [[nodiscard]] Result<void> add_relief_casts(const Pack& pack, const std::vector<int>& texels,
                                                const PictureOptions& options);

    /// The picture that technique `k` (of `results()`) draws for a pose: sRGB codes.
    [[nodiscard]] Image8 picture(std::size_t k, const BenchPose& pose);

    [[nodiscard]] Result<Drawn> drawn(std::size_t k, const BenchPose& pose);

    /// Draws `poses` with techniques [first, end) and measures each picture against the truth.
    [[nodiscard]] Result<void> measure_errors(const Truth& truth, const std::vector<BenchPose>& poses,
                                              std::size_t first, const Progress& progress);
    /// The same for all techniques of the places alone, `rays` a pixel, 1, 2, 4, 8 or 16; errors of colour mean nothing then.
    [[nodiscard]] Result<void> measure_shape(const Truth& truth, const std::vector<BenchPose>& poses,
                                             int rays, const Progress& progress);
    void measure_times(const std::vector<BenchPose>& poses, int rounds, const Progress& progress);

    [[nodiscard]] const Stage& stage() const { return stage_; }
    [[nodiscard]] std::string driver() const { return display_->name(); }
    [[nodiscard]] const std::vector<TechniqueResult>& results() const { return results_; }

private:
    TechniqueSet(std::unique_ptr<Display> display, Stage stage)
        : display_(std::move(display)), stage_(std::move(stage)) {}
    [[nodiscard]] Result<void> add_auto_mesh(const Pack& pack, const Rung& rung, PictureOptions options);
    /// The pack's reliefs of the texels that are wanted.
    [[nodiscard]] Result<void> add_pack_reliefs(const Pack& pack, TechniqueKind kind,
                                                const PictureOptions& options,
                                                const std::function<bool(std::uint32_t)>& wanted);
    /// Without colour.
    [[nodiscard]] Result<Drawn> places(std::size_t k, const BenchPose& pose);
    /// The light that the exhibit shows the pack in; nothing where no technique is the exhibit's.
    [[nodiscard]] std::optional<LightAim> shown_light(const BenchPose& pose) const;
    [[nodiscard]] ShownImages shown_images(ShownPicture& shown, const BenchPose& pose) const;
    /// Of each technique; the floor's mean nothing.
    [[nodiscard]] Result<std::vector<PictureError>> shape_errors(const Truth& truth, const BenchPose& pose);
    [[nodiscard]] Result<void> add_relief(const Pack& pack, TechniqueKind kind, BlockRelief relief,
                                          const std::optional<SeenLevel>& seen, const PictureOptions& options,
                                          const std::string& name);
    [[nodiscard]] Result<void> add(Result<std::unique_ptr<Technique>> technique, TechniqueResult result);
    /// Pictures of the level, or of the relief, are then held against rays at its own surface, too. Gives the surface's name.
    [[nodiscard]] Result<std::string> keep_drawn(const Pack& pack, std::uint32_t level);
    [[nodiscard]] Result<std::string> keep_drawn(const Pack& pack, const BlockRelief& relief,
                                                 const std::string& name);
    [[nodiscard]] Result<std::string> keep_surface(const Pack& pack, SourceMesh surface,
                                                   const std::string& name);
    using MakePeer =
        std::function<Result<std::unique_ptr<Technique>>(const std::shared_ptr<const PeerSamples>&)>;
    [[nodiscard]] Result<void> add_sampled(const MakePeer& make, const TechniqueResult& result,
                                           const std::vector<int>& samples);

    std::unique_ptr<Display> display_; ///< first: its context outlives everything below
    Stage stage_;
    std::map<std::string, Truth> drawn_;                             ///< by the surface's name
    std::map<int, std::shared_ptr<const PeerSamples>> peer_samples_; ///< by their number; none for one
    std::vector<std::unique_ptr<Technique>> techniques_;
    std::vector<TechniqueResult> results_; ///< one for each technique
};

/// Sets what is measured in the floor's time; the faster of its filters is the unit. One floor at least.
void in_units_of_floor(std::span<TechniqueResult> results);

} // namespace frustumscreen
