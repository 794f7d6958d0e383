/// Subject of the relief's tests: a ring, as a relief and as the truth.
///
/// Threads  values; any.
#pragma once

#include "app/bench/truth/poses.h"
#include "app/bench/truth/truth.h"
#include "app/relief/rasterize_blocks.h"
#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/box_frame.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/ring.h"

#include <memory>
#include <vector>

namespace frustumscreen::relief {

inline const std::vector<pack::ReliefDirection> frustum_directions = {
    pack::ReliefDirection::PlusX, pack::ReliefDirection::MinusX, pack::ReliefDirection::PlusY,
    pack::ReliefDirection::MinusY, pack::ReliefDirection::PlusZ};

/// A mesh in the prop frame, as a relief and as the truth.
struct Subject {
    std::shared_ptr<bake::SourceMesh> mesh = bench::ring();
    bake::BoxFrame frame = bake::make_box_frame(*mesh, {}).value();
    std::vector<glm::dvec3> points = bake::in_box(*mesh, frame);
    bake::SourceScene surface{*mesh, points, bake::Sides::Both};
    bench::Truth truth = bench::Truth::build(mesh, glm::dmat4(1.0)).value();

    [[nodiscard]] BlockRelief relief(int texels) const {
        return bake::bake_blocks({surface, frame.box_size, frustum_directions, texels});
    }
    /// Sets up the view of an eye.
    void show(RasterView& view, const settings::Settings& settings, const geometry::PropShape& prop,
              const bench::BenchPose& pose) const {
        const bench::TruthView from = bench::view_of(settings, pose);
        set_up(view, prop,
               {glm::inverse(frame.box_from_file), frame.box_size, from.projector, from.prop_from_projector,
                from.eye_m});
    }
};

} // namespace frustumscreen::relief
