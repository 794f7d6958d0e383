/// The two ways to choose what each cell is drawn as, frame by frame, on the same cells and the same renderer.
///
/// ours     the exhibit's own RunCells: a knapsack over the cells, with the governor's time model, hysteresis and fades.
/// paper    Kim 2008 (paper_choice.h): polygons at the pack's finest level, or relief with texels of about a pixel. It
///          switches hard, as the paper does. All else is the exhibit's, so that the choice alone is compared: its relief
///          rasterizer, its culling, its depth across cells. The paper draws three faces a cell from back to front and
///          merges cells whose boxes collide; both approximate that depth and could only be worse.
/// Threads  that of the set, which must outlive the technique.
#pragma once

#include "app/bench/mixed/cell_set.h"
#include "app/bench/mixed/paper_choice.h"

#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::bench {

class MixedTechnique {
public:
    virtual ~MixedTechnique() = default;
    /// Call before the walk's first frame.
    virtual void begin() = 0;
    /// Chooses, plans and draws the whole picture; the caller waits until it is drawn.
    virtual void draw(std::size_t frame, const BenchPose& pose) = 0;
    /// The plan of the latest picture.
    [[nodiscard]] virtual const scene::FramePlan& plan() const = 0;
    /// Cells that changed since `begin`.
    [[nodiscard]] virtual std::size_t switches() const = 0;
};

/// `deadline_ms`: of a frame, as the exhibit's.
[[nodiscard]] std::unique_ptr<MixedTechnique> make_ours(CellSet& set, double deadline_ms,
                                                        const scene::FrameCost& cost);
[[nodiscard]] std::unique_ptr<MixedTechnique> make_paper(CellSet& set, const PaperWeights& weights,
                                                         double polygons_a_frame);
/// Every cell at one share of its levels, 0: the finest, 1: the coarsest; or every cell as relief, 0: the finest.
[[nodiscard]] std::unique_ptr<MixedTechnique> make_uniform(CellSet& set, double share, bool relief);

/// The work that the time model counts, of all cells drawn as `make_uniform` draws them.
[[nodiscard]] scene::FrameWork uniform_work(const CellSet& set, double share, bool relief,
                                            const BenchPose& pose);

/// The quantities of Eq. (1) for each cell of a frame.
[[nodiscard]] std::vector<PaperCell> paper_cells(const CellSet& set, const BenchPose& pose);

} // namespace frustumscreen::bench
