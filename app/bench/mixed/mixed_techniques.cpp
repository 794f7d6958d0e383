#include "app/bench/mixed/mixed_techniques.h"

#include "app/bench/mixed/mixed_walk.h"
#include "app/scene/cell_plan.h"
#include "firmware_host/base/time.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::bench {

namespace {

MonotonicTime time_of(std::size_t frame) {
    return MonotonicTime{} + std::chrono::duration_cast<Nanoseconds>(
                                 std::chrono::duration<double>(static_cast<double>(frame) / walk_hz));
}

class Ours final : public MixedTechnique {
public:
    Ours(CellSet& set, double deadline_ms, const scene::FrameCost& cost)
        : set_(set), deadline_ms_(deadline_ms), cost_(cost) {}

    void begin() override {
        cells_ = set_.run_cells(deadline_ms_, cost_);
        cells_->player().start(0, time_of(0));
    }
    void draw(std::size_t frame, const BenchPose& pose) override {
        const scene::PlanView view = set_.view(pose);
        constexpr double idle = 1.0;
        (void)cells_->step(time_of(frame), idle);
        (void)cells_->draw(time_of(frame), set_.whole(), set_.prop(), std::span(&view, 1), set_.renderer(),
                           set_.target(), render::Redraw::Everything);
    }
    [[nodiscard]] const scene::FramePlan& plan() const override { return cells_->plans().front(); }
    [[nodiscard]] std::size_t switches() const override { return cells_->switches(); }

private:
    CellSet& set_;
    double deadline_ms_;
    scene::FrameCost cost_;
    std::unique_ptr<residency::RunCells> cells_;
};

/// Draws the parts that a choice gives.
class Parts {
public:
    explicit Parts(CellSet& set)
        : set_(set), plan_(scene::make_plan(set.prop(), set.max_indices(), set.cells().size())) {
        parts_.reserve(set.cells().size());
    }
    template <typename WayOf> void draw(const BenchPose& pose, const WayOf& way_of) {
        parts_.clear();
        for (std::size_t k = 0; k < set_.cells().size(); ++k) {
            parts_.push_back({way_of(k).placed, std::nullopt});
        }
        scene::plan_frame(set_.prop(), parts_, set_.view(pose), plan_);
        set_.renderer().draw(plan_, set_.target(), render::Redraw::Everything);
    }
    [[nodiscard]] const scene::FramePlan& plan() const { return plan_; }

private:
    CellSet& set_;
    scene::FramePlan plan_;
    std::vector<scene::Part> parts_;
};

/// The coarsest one whose texel is not clearly larger than a pixel in the middle of the table; otherwise the finest.
const CellWay& paper_relief(const CellSet& set, const CellWays& cell) {
    constexpr double not_clearly = 1.25; // as quality_level_of has it
    const settings::ProjectorSettings& projector = set.settings().projector;
    const double pixel_m = projector.table_from_projector.translation.z / projector.pinhole.fx;
    const auto fine = std::find_if(cell.reliefs.begin(), cell.reliefs.end(),
                                   [&](const CellWay& way) { return way.texel_m <= not_clearly * pixel_m; });
    return fine != cell.reliefs.end() ? *fine : cell.reliefs.back();
}

const CellWay& way_of(const CellSet& set, const CellWays& cell, bool polygons) {
    return polygons || cell.reliefs.empty() ? cell.meshes.front() : paper_relief(set, cell);
}

PaperCell paper_cell(const CellSet& set, const CellWays& cell, const BenchPose& pose) {
    const scene::PlanView view = set.view(pose);
    const geometry::Pinhole& pinhole = view.projector;
    const CellWay& mesh = cell.meshes.front();
    const CellWay& relief = way_of(set, cell, false);
    const glm::dmat4 prop_from_box = mesh.placed.prop_from_box();
    const glm::dvec3 middle = pose.table_from_prop.point(
        glm::dvec3(prop_from_box * glm::dvec4(0.0, 0.0, 0.5 * mesh.placed.box_size.z, 1.0)));
    const glm::dvec3 to_cell = middle - pose.eye_m;
    const glm::dvec3 gaze = pose.table_from_prop.point(set.prop().middle) - pose.eye_m; // at the prop
    const double away_m = glm::length(to_cell);
    const double pixels_per_m = pinhole.fx / glm::distance(middle, view.table_from_projector.translation);
    const double pixels = scene::pixels_of(mesh.placed, view);
    return {.texel_px = relief.texel_m * pixels_per_m,
            .away_m = away_m,
            .cosine = glm::dot(to_cell, gaze) / (away_m * glm::length(gaze)),
            .area_share = pixels / (static_cast<double>(pinhole.width) * pinhole.height),
            .polygons = mesh.polygons,
            .relief_error_mm = pixels * relief.worst_mm,
            .polygon_error_mm = pixels * mesh.worst_mm};
}

class Paper final : public MixedTechnique {
public:
    Paper(CellSet& set, const PaperWeights& weights, double polygons_a_frame)
        : set_(set), start_(weights, polygons_a_frame), choice_(start_), parts_(set) {}

    void begin() override { choice_ = start_; }
    void draw(std::size_t /*frame*/, const BenchPose& pose) override {
        const std::span<const std::uint8_t> polygons = choice_.choose(paper_cells(set_, pose));
        parts_.draw(pose, [&](std::size_t cell) -> const CellWay& {
            return way_of(set_, set_.cells()[cell], polygons[cell] != 0);
        });
    }
    [[nodiscard]] const scene::FramePlan& plan() const override { return parts_.plan(); }
    [[nodiscard]] std::size_t switches() const override { return choice_.switches(); }

private:
    CellSet& set_;
    PaperChoice start_, choice_;
    Parts parts_;
};

const CellWay& uniform_way(const CellWays& cell, double share, bool relief) {
    const bool is_relief = relief && !cell.reliefs.empty();
    const std::vector<CellWay>& ways = is_relief ? cell.reliefs : cell.meshes;
    const double from_finest = is_relief ? 1.0 - share : share;
    return ways[static_cast<std::size_t>(std::lround(from_finest * static_cast<double>(ways.size() - 1)))];
}

class Uniform final : public MixedTechnique {
public:
    Uniform(CellSet& set, double share, bool relief)
        : set_(set), share_(share), relief_(relief), parts_(set) {}

    void begin() override {}
    void draw(std::size_t /*frame*/, const BenchPose& pose) override {
        parts_.draw(pose, [&](std::size_t cell) -> const CellWay& {
            return uniform_way(set_.cells()[cell], share_, relief_);
        });
    }
    [[nodiscard]] const scene::FramePlan& plan() const override { return parts_.plan(); }
    [[nodiscard]] std::size_t switches() const override { return 0; }

private:
    CellSet& set_;
    double share_;
    bool relief_;
    Parts parts_;
};

} // namespace

std::unique_ptr<MixedTechnique> make_ours(CellSet& set, double deadline_ms, const scene::FrameCost& cost) {
    return std::make_unique<Ours>(set, deadline_ms, cost);
}

std::unique_ptr<MixedTechnique> make_paper(CellSet& set, const PaperWeights& weights,
                                           double polygons_a_frame) {
    return std::make_unique<Paper>(set, weights, polygons_a_frame);
}

std::unique_ptr<MixedTechnique> make_uniform(CellSet& set, double share, bool relief) {
    return std::make_unique<Uniform>(set, share, relief);
}

scene::FrameWork uniform_work(const CellSet& set, double share, bool relief, const BenchPose& pose) {
    scene::FrameWork work;
    for (const CellWays& cell : set.cells()) {
        const CellWay& way = uniform_way(cell, share, relief);
        work.triangles += way.triangles;
        work.pixels += scene::pixels_of(way.placed, set.view(pose));
    }
    return work;
}

std::vector<PaperCell> paper_cells(const CellSet& set, const BenchPose& pose) {
    std::vector<PaperCell> cells;
    for (const CellWays& cell : set.cells()) {
        cells.push_back(paper_cell(set, cell, pose));
    }
    return cells;
}

} // namespace frustumscreen::bench
