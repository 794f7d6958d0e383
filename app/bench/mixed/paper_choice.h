/// The peer of scene::CellChoice: which cells are polygons and which are relief, as Kim 2008 decides it in each frame.
///
/// Eq. (1)  I(A, O) = u P(O) + v / |PA - PO| + w cos(theta_AO) + x S(O), with weights 0..1.
/// Rule     the most important cells are polygons, as long as the frame's polygons suffice; the others are relief. A
///          cell whose relief has texels no larger than a pixel stays relief ("when each pixel of the texture
///          projects to more than one pixel on the viewing plane").
/// Weights  "determined empirically": the search tries a grid of them on a walk of its own and keeps those with the
///          least error, by the pack's own errors of each cell.
///
/// Units    pixels; metres; S as a share of the picture, because the paper names no unit and the weights do not exceed 1;
///          polygons of one frame: those of a second, over the frames of a second.
/// Threads  pure; any. `PaperChoice::choose` allocates nothing once it has seen as many cells.
/// Errors   none.
/// Source   Kim 2008, "Switching between representations" and "Building a virtual environment with mixed representation
///          objects".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::bench {

/// A cell in one frame.
struct PaperCell {
    double texel_px = 0.0;   ///< P: pixels of the picture for one texel
    double away_m = 1.0;     ///< |PA - PO|
    double cosine = 1.0;     ///< between the direction of view and the direction towards the cell
    double area_share = 0.0; ///< S
    std::size_t polygons = 0;
    double relief_error_mm = 0.0, polygon_error_mm = 0.0; ///< of the whole picture; for the search alone
};

struct PaperWeights {
    double u = 1.0, v = 1.0, w = 1.0, x = 1.0;
};

[[nodiscard]] double importance(const PaperCell& cell, const PaperWeights& weights);

/// Chooses for each cell of a frame, and counts the changes from frame to frame.
class PaperChoice {
public:
    PaperChoice(PaperWeights weights, double polygons_a_frame)
        : weights_(weights), polygons_a_frame_(polygons_a_frame) {}

    /// For each cell 1: polygons, 0: relief. Valid until the next call.
    [[nodiscard]] std::span<const std::uint8_t> choose(std::span<const PaperCell> cells);
    /// Cells that changed from one call to the next, so far.
    [[nodiscard]] std::size_t switches() const { return switches_; }

private:
    PaperWeights weights_;
    double polygons_a_frame_;
    std::vector<std::size_t> order_;
    std::vector<double> importance_;
    std::vector<std::uint8_t> polygons_, before_;
    std::size_t switches_ = 0;
};

/// The weights with the least error, summed over all frames and budgets. `frames`: each with the same cells;
/// `budgets`: polygons of a frame.
[[nodiscard]] PaperWeights find_weights(std::span<const std::vector<PaperCell>> frames,
                                        std::span<const double> budgets);

} // namespace frustumscreen::bench
