/// The ways to draw a torch's light that `frustumscreen-bench torch` compares, frame by frame, on the same renderer.
///
/// none            the same frame without a torch.
/// ours            the exhibit's: the attenuation at each pixel, shadows from the torch's own picture.
/// ours_no_shadow  the same without shadows, which the paper has not.
/// paper           Francken 2007: polygons, split to an edge length (paper_torch.h).
/// paper_steered   the same; the tolerance is steered from frame to frame to hold a frame time.
/// paper_fixed     the same at the mean tolerance of `paper_steered`.
/// paper_curvature the same, split by the bound of the error (torch/splitting.h).
/// Threads         that of the set, which must outlive the technique.
/// Errors          as PaperTorch.
#pragma once

#include "app/bench/torch/paper_torch.h"
#include "app/bench/torch/torch_sweep.h"

#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct TorchWay {
    enum class Kind : std::uint8_t { None, Ours, OursNoShadow, Paper };
    std::string name;
    Kind kind = Kind::None;
    torch::Splitting::By by = torch::Splitting::By::Length;
    std::vector<double> tolerances = {}; ///< of the paper, one for each frame: metres, or intensity
    int samples = 1;                     ///< a pixel; the paper's pass draws one alone
};

class TorchTechnique {
public:
    [[nodiscard]] static Result<std::unique_ptr<TorchTechnique>>
    create(TorchSet& set, const TorchScene& scene, const torch::Beam& beam, TorchWay way);

    [[nodiscard]] const TorchWay& way() const { return way_; }
    /// Plans and draws the whole picture; the caller waits until it is drawn. `in_black`: of the black surfaces.
    void draw(const TorchFrame& frame, std::size_t number, bool in_black);
    void set_tolerance(std::size_t number, double tolerance) { way_.tolerances.at(number) = tolerance; }
    /// The plan of the latest picture.
    [[nodiscard]] const scene::FramePlan& plan() const { return plan_; }
    /// The latest picture's triangles after splitting; 0 if the technique does not split.
    [[nodiscard]] std::size_t lit_triangles() const { return paper_.triangles(); }

private:
    TorchTechnique(TorchSet& set, const TorchScene& scene, const torch::Beam& beam, TorchWay way,
                   PaperTorch paper);

    TorchSet& set_;
    TorchSurface surface_;
    torch::Beam beam_;
    TorchWay way_;
    torch::Content content_;
    PaperTorch paper_;
    scene::FramePlan plan_;
};

} // namespace frustumscreen::bench
