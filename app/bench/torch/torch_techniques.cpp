#include "app/bench/torch/torch_techniques.h"

#include "app/scene/torch_plan.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::bench {

namespace {

bool is_paper(const TorchWay& way) {
    return way.kind == TorchWay::Kind::Paper;
}

} // namespace

Result<std::unique_ptr<TorchTechnique>> TorchTechnique::create(TorchSet& set, const TorchScene& scene,
                                                               const torch::Beam& beam, TorchWay way) {
    TRY(PaperTorch paper, PaperTorch::create());
    return std::unique_ptr<TorchTechnique>(
        new TorchTechnique(set, scene, beam, std::move(way), std::move(paper)));
}

TorchTechnique::TorchTechnique(TorchSet& set, const TorchScene& scene, const torch::Beam& beam, TorchWay way,
                               PaperTorch paper)
    : set_(set), surface_(is_paper(way) ? scene.polygons : scene.drawn), beam_(beam), way_(std::move(way)),
      content_(white_over()), paper_(std::move(paper)),
      plan_(scene::make_plan(set.prop(), scene.max_indices, surface_.parts.size())) {
    for (auto* const parts : {&surface_.parts, &surface_.black}) {
        for (scene::Part& part : *parts) {
            part.level.samples = way_.samples;
        }
    }
    scene::make_torch_space(plan_, set.prop().faces.size(), scene.max_indices, surface_.parts.size());
}

void TorchTechnique::draw(const TorchFrame& frame, std::size_t number, bool in_black) {
    scene::PlacedTorch torch = scene::placed(content_, beam_, frame.table_from_torch, 0.0);
    torch.casts_shadows = way_.kind == TorchWay::Kind::Ours;
    scene::PlanView view = set_.cells().view(frame.pose);
    if (way_.kind == TorchWay::Kind::Ours || way_.kind == TorchWay::Kind::OursNoShadow) {
        view.torches = {&torch, 1};
    }
    scene::plan_frame(set_.prop(), in_black ? surface_.black : surface_.parts, view, plan_);
    if (way_.samples == 1) { // the plan adds samples where a face is seen slantingly
        plan_.samples = 1;
        for (scene::ReliefDraw& relief_draw : plan_.relief_draws) {
            relief_draw.samples = 1;
        }
    }
    const render::RenderTarget target = set_.cells().target();
    set_.cells().renderer().draw(plan_, target, render::Redraw::Everything);
    if (is_paper(way_)) {
        const geometry::RigidTransform torch_from_prop =
            frame.table_from_torch.inverse() * frame.pose.table_from_prop;
        paper_.draw(set_, plan_, torch_from_prop.matrix(), beam_, {way_.by, way_.tolerances.at(number)},
                    target.framebuffer);
    }
}

} // namespace frustumscreen::bench
