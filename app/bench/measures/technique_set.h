/// The techniques that one run compares: all for one kiosk, on one display of their own.
///
/// Threads  the one that opened the set: the display's context is current there.
/// Errors   no display; any error from making a technique.
#pragma once

#include "app/bench/measures/measure.h"
#include "app/bench/measures/timing.h"
#include "app/bench/techniques/pack_level.h"
#include "app/bench/techniques/peer_choice.h"
#include "app/bench/techniques/peers.h"
#include "app/pack/pack_file.h"
#include "app/scene/governor.h"
#include "firmware_host/display/display.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// Settings and their name in tables.
struct SetUp {
    std::string name;
    settings::Settings settings;
};

enum class TechniqueKind {
    Floor,
    PackLevel,
    PackRelief, ///< the pack's layered relief at one resolution; `triangles` counts blocks
    Auto,       ///< the level that the exhibit's governor chooses in this set-up while frames are in time
    Cells,      ///< the pack's cells at rest, each as the exhibit draws it; `triangles` counts blocks, too
    FullMesh,
    TwoPass,
    RayCast, ///< the method that computes the truth, as a peer
    Lod,
    TwoPassLod,
    Relief,       ///< relief images, marched or warped
    ReliefRaster, ///< layered relief that is not in the pack; `triangles` counts blocks
    ReliefGpu,    ///< the pack's layered relief, drawn by the GPU; `triangles` counts blocks
};
/// The name in tables and files.
[[nodiscard]] std::string_view name_of(TechniqueKind kind);

struct TechniqueResult {
    std::string name;
    TechniqueKind kind = TechniqueKind::PackLevel;
    int level = -1;                   ///< PackLevel, Auto
    std::string drawn_as;             ///< key of the surface for `drawn_shift_px`; empty: not requested
    std::uint64_t bytes = 0;          ///< pack's level or relief in main memory; 0: not from a pack
    std::uint64_t triangles = 0;      ///< drawn triangles
    int samples = 1;                  ///< samples per pixel
    std::vector<PictureError> errors; ///< one per pose; empty for the floor
    std::vector<std::optional<scene::ErrorEstimate>>
        estimates; ///< the exhibit's estimates, one per pose; nullopt
                   ///< for peers
    ErrorSummary error;
    Spread time_ms;
    double times_floor = 0.0; ///< median / median of the faster floor
    double cpu_ms = 0.0;      ///< median, all threads
    double cpu_times_floor = 0.0;
};

class TechniqueSet {
public:
    /// Opens a set with the floors, one per filter.
    [[nodiscard]] static Result<std::unique_ptr<TechniqueSet>> open(const SetUp& set_up);
    TechniqueSet(const TechniqueSet&) = delete;
    TechniqueSet& operator=(const TechniqueSet&) = delete;

    /// The exhibit's choice while frames are in time: the mesh level that is good enough, and a relief
    /// if one is. The exhibit measures both and chooses the faster. The pack must outlive the set.
    [[nodiscard]] Result<void> add_auto(const pack::Pack& pack, const PictureOptions& options);
    [[nodiscard]] Result<void> add_level(const pack::Pack& pack, std::uint32_t level,
                                         const PictureOptions& options);
    /// `samples` here and below: per pixel; each peer is added once for each number.
    [[nodiscard]] Result<void> add_peers(const bake::SourceMesh& mesh, const glm::dmat4& prop_from_artifact,
                                         bool full_mesh, const std::vector<int>& two_pass_pixels,
                                         const std::vector<int>& samples = {1});
    [[nodiscard]] Result<void> add_ray_cast(const Truth& truth, const std::vector<int>& samples = {1});
    /// Adds the simplified source, drawn through the collineation and by two passes, as `choice` selects.
    [[nodiscard]] Result<void> add_levels_of_detail(const bake::SourceMesh& mesh,
                                                    const glm::dmat4& prop_from_artifact,
                                                    const PeerChoice& choice);

    /// Adds peers that show relief images of `texels` per side.
    [[nodiscard]] Result<void> add_relief_peers(const Truth& truth, const bake::SourceMesh& mesh,
                                                const glm::dmat4& prop_from_artifact, int texels);

    /// The pack's reliefs, one per resolution. The pack must outlive the set.
    [[nodiscard]] Result<void> add_reliefs(const pack::Pack& pack, const PictureOptions& options);
    /// The pack's relief with the most texels.
    [[nodiscard]] Result<void> add_finest_relief(const pack::Pack& pack, const PictureOptions& options);
    /// The pack's reliefs, drawn by the GPU.
    [[nodiscard]] Result<void> add_reliefs_on_gpu(const pack::Pack& pack, const PictureOptions& options);
    /// Reliefs of other resolutions, made from the pack's finest level. The pack must outlive the set.
    [[nodiscard]] Result<void> add_relief_rasters(const pack::Pack& pack, const std::vector<int>& texels,
                                                  const PictureOptions& options);

    /// The pack's cells at rest; `file`: the pack's. Returns how each is drawn, a line each.
    [[nodiscard]] Result<std::string> add_cells(const std::filesystem::path& file, const pack::Pack& pack,
                                                const PictureOptions& options);

    /// The picture that technique `k` (of `results()`) draws for a pose: sRGB codes.
    [[nodiscard]] image::Image8 picture(std::size_t k, const BenchPose& pose);

    [[nodiscard]] Result<Drawn> drawn(std::size_t k, const BenchPose& pose);

    /// Draws `poses` with techniques [first, end) and measures each picture against the truth.
    [[nodiscard]] Result<void> measure_errors(const Truth& truth, const std::vector<BenchPose>& poses,
                                              std::size_t first, const Progress& progress);
    /// Measures shape errors of all techniques, with `rays` per pixel: 1, 2, 4, 8 or 16. Colour errors are
    /// then meaningless.
    [[nodiscard]] Result<void> measure_shape(const Truth& truth, const std::vector<BenchPose>& poses,
                                             int rays, const Progress& progress);
    void measure_times(const std::vector<BenchPose>& poses, int rounds, const Progress& progress);

    [[nodiscard]] const Kiosk& kiosk() const { return kiosk_; }
    [[nodiscard]] std::string driver() const { return display_->name(); }
    [[nodiscard]] const std::vector<TechniqueResult>& results() const { return results_; }

private:
    TechniqueSet(std::unique_ptr<display::Display> display, Kiosk kiosk)
        : display_(std::move(display)), kiosk_(std::move(kiosk)) {}
    [[nodiscard]] Result<void> add_auto_mesh(const pack::Pack& pack, const scene::QualityLevel& quality_level,
                                             PictureOptions options);
    /// Adds the pack's reliefs whose texel count is `wanted`.
    [[nodiscard]] Result<void> add_pack_reliefs(const pack::Pack& pack, TechniqueKind kind,
                                                const PictureOptions& options,
                                                const std::function<bool(std::uint32_t)>& wanted);
    /// Hit points without colour.
    [[nodiscard]] Result<Drawn> places(std::size_t k, const BenchPose& pose);
    /// The light in which the exhibit shows the pack; nullopt if no technique is the exhibit's.
    [[nodiscard]] std::optional<LightAim> shown_light(const BenchPose& pose) const;
    [[nodiscard]] ShownImages shown_images(ShownPicture& shown, const BenchPose& pose) const;
    /// One per technique; the floor's entries are meaningless.
    [[nodiscard]] Result<std::vector<PictureError>> shape_errors(const Truth& truth, const BenchPose& pose);
    [[nodiscard]] Result<void> add_relief(const pack::Pack& pack, TechniqueKind kind,
                                          relief::BlockRelief relief,
                                          const std::optional<scene::SeenLevel>& seen,
                                          const PictureOptions& options, const std::string& name);
    [[nodiscard]] Result<void> add(Result<std::unique_ptr<Technique>> technique, TechniqueResult result);
    /// Also measures pictures of the level, or of the relief, against rays at its own surface. Returns the
    /// surface's name.
    [[nodiscard]] Result<std::string> keep_drawn(const pack::Pack& pack, std::uint32_t level);
    [[nodiscard]] Result<std::string> keep_drawn(const pack::Pack& pack, const relief::BlockRelief& relief,
                                                 const std::string& name);
    [[nodiscard]] Result<std::string> keep_surface(const pack::Pack& pack, bake::SourceMesh surface,
                                                   const std::string& name);
    using MakePeer =
        std::function<Result<std::unique_ptr<Technique>>(const std::shared_ptr<const PeerSamples>&)>;
    [[nodiscard]] Result<void> add_sampled(const MakePeer& make, const TechniqueResult& result,
                                           const std::vector<int>& samples);

    std::unique_ptr<display::Display> display_; ///< first: its context outlives everything below
    Kiosk kiosk_;
    std::map<std::string, Truth> drawn_;                             ///< by name of the surface
    std::map<int, std::shared_ptr<const PeerSamples>> peer_samples_; ///< by number of samples; no entry for
                                                                     ///< one sample
    std::vector<std::unique_ptr<Technique>> techniques_;
    std::vector<TechniqueResult> results_; ///< one per technique
};

/// Expresses the measured times in units of the floor, the faster of its filters. Requires at least one
/// floor.
void in_units_of_floor(std::span<TechniqueResult> results);

} // namespace frustumscreen::bench
