/// A pack's cells on a display of their own, at rest, each in every way that the pack has: what both techniques of
/// `frustumscreen-bench mixed` draw from.
///
/// Light    none: a texture's codes pass unchanged, as in a ray cast.
/// Frames   as PlanView.
/// Threads  the one that opened the set: the display's context is current there.
/// Errors   no display; a pack without cells; any error of reading and planning them.
#pragma once

#include "app/bench/techniques/technique.h"
#include "app/pack/pack_file.h"
#include "app/render/hit_points.h"
#include "app/render/renderer.h"
#include "app/residency/known_world.h"
#include "app/residency/run_cells.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/display/surfaceless_display.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::bench {

/// One way to draw a cell.
struct CellWay {
    scene::PlacedLevel placed; ///< posed at rest
    double worst_mm = 0.0;     ///< error for the eyes that see the most of it
    double triangles = 0.0;    ///< that the governor counts: half of them, or the blocks of a relief
    std::size_t polygons = 0;  ///< 0 for a relief
    double texel_m = 0.0;      ///< of a relief
};
struct CellWays {
    std::vector<CellWay> meshes;  ///< finest first
    std::vector<CellWay> reliefs; ///< coarsest first
};

class CellSet {
public:
    /// `samples`: a pixel; 0: the pack's own number. `torch`: the parts of a torch's content (torch::ContentPart).
    [[nodiscard]] static Result<std::unique_ptr<CellSet>>
    open(const settings::Settings& settings, const std::filesystem::path& pack, int samples,
         std::optional<std::uint8_t> torch = std::nullopt);
    CellSet(const CellSet&) = delete;
    CellSet& operator=(const CellSet&) = delete;

    [[nodiscard]] const std::vector<CellWays>& cells() const { return cells_; }
    [[nodiscard]] const geometry::PropShape& prop() const { return plan_.prop; }
    [[nodiscard]] const settings::Settings& settings() const { return settings_; }
    [[nodiscard]] scene::PlanView view(const BenchPose& pose) const;
    /// Indices of all cells at their finest, twice: space for a plan.
    [[nodiscard]] std::size_t max_indices() const { return max_indices_; }

    /// The exhibit's own cells, with a behaviour that runs for ever and moves nothing. `deadline_ms`: as the exhibit's.
    [[nodiscard]] std::unique_ptr<residency::RunCells> run_cells(double deadline_ms,
                                                                 const scene::FrameCost& cost) const;
    /// The whole artifact as RunCells asks for it: only its samples count.
    [[nodiscard]] const scene::PlacedLevel& whole() const { return whole_; }

    [[nodiscard]] render::Renderer& renderer() { return *renderer_; }
    [[nodiscard]] render::RenderTarget target() const { return {display_->framebuffer(), 0}; }
    /// The hit point of each pixel in this plan, which need not be the one drawn last.
    [[nodiscard]] image::ImageFloat hit_points(const scene::FramePlan& plan);
    void read_colour_into(image::Image8& picture) const;

private:
    CellSet(settings::Settings settings, scene::ScenePlan plan)
        : settings_(std::move(settings)), plan_(std::move(plan)) {}
    [[nodiscard]] Result<void> upload(std::optional<std::uint8_t> torch);
    void list_ways();

    settings::Settings settings_;
    scene::ScenePlan plan_;                                ///< of the whole artifact
    std::unique_ptr<display::SurfacelessDisplay> display_; ///< first of all that lives in its context
    std::optional<render::Renderer> renderer_;
    std::optional<render::HitPointRenderer> hit_points_;
    std::shared_ptr<const residency::KnownWorld> known_;
    residency::PreparedCells prepared_;
    std::vector<scene::Drawable> drawables_; ///< one for each of PreparedCells::levels
    std::vector<CellWays> cells_;
    scene::PlacedLevel whole_;
    std::size_t max_indices_ = 0;
};

} // namespace frustumscreen::bench
