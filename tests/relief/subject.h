/// Subject of the relief's tests: a ring, as a relief and as the truth.
///
/// Threads  values; any.
#pragma once

#include "app/bench/truth/poses.h"
#include "app/bench/truth/truth.h"
#include "app/relief/rasterize_blocks.h"
#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/box_frame.h"
#include "tests/bench/near_stage.h"
#include "tests/bench/ring.h"

#include <memory>
#include <vector>

namespace frustumscreen {

inline const std::vector<ReliefDirection> frustum_directions = {
    ReliefDirection::PlusX, ReliefDirection::MinusX, ReliefDirection::PlusY, ReliefDirection::MinusY,
    ReliefDirection::PlusZ};

/// A mesh in the prop frame, as a relief and as the truth.
struct Subject {
    std::shared_ptr<SourceMesh> mesh = ring();
    BoxFrame frame = make_box_frame(*mesh, {}).value();
    std::vector<glm::dvec3> points = in_box(*mesh, frame);
    SourceScene surface{*mesh, points, Sides::Both};
    Truth truth = Truth::build(mesh, glm::dmat4(1.0)).value();

    [[nodiscard]] BlockRelief relief(int texels) const {
        return bake_blocks({surface, frame.box_size, frustum_directions, texels});
    }
    /// Sets up the view of an eye.
    void show(RasterView& view, const Settings& settings, const PropShape& prop,
              const BenchPose& pose) const {
        const TruthView from = view_of(settings, pose);
        set_up(view, prop,
               {glm::inverse(frame.box_from_file), frame.box_size, from.projector, from.prop_from_projector,
                from.eye_m});
    }
};

} // namespace frustumscreen
