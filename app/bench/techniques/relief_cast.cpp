#include "app/bench/techniques/relief_cast.h"

#include "app/bench/techniques/memory_picture.h"
#include "app/pack/pack_file.h"
#include "app/relief/relief_painter.h"
#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/box_frame.h"
#include "firmware_host/base/usable_cores.h"

#include <fmt/format.h>

namespace frustumscreen {

namespace {

class ReliefCast final : public Technique {
public:
    ReliefCast(const Stage& stage, BlocksInBox blocks, int samples, MemoryPicture picture)
        : stage_(stage), blocks_(std::move(blocks)), samples_(samples), picture_(std::move(picture)),
          painter_(static_cast<int>(usable_cores())) {}

    [[nodiscard]] std::string name() const override {
        return fmt::format("relief cast {:.0f}, {} sample{}", 1.0F / blocks_.relief.texel_box, samples_,
                           samples_ == 1 ? "" : "s");
    }
    void draw(const BenchPose& pose) override {
        set_up_view(pose);
        Image8& codes = picture_.codes;
        picture_.show(stage_, painter_.paint(blocks_.relief, view_, samples_,
                                             {codes.texels.data(), codes.width, codes.height, codes.width}));
    }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        set_up_view(pose);
        ImageFloat points(stage_.width(), stage_.height());
        painter_.hit_points(blocks_.relief, view_,
                            {points.texels.data(), points.width, points.height, points.width});
        for (glm::vec3& point : points.texels) {
            point = glm::vec3(blocks_.prop_from_box * glm::dvec4(point, 1.0));
        }
        return points;
    }

private:
    void set_up_view(const BenchPose& pose) {
        const TruthView view = view_of(stage_.settings, pose);
        set_up(
            view_, stage_.prop,
            {blocks_.prop_from_box, blocks_.box_size, view.projector, view.prop_from_projector, view.eye_m});
    }

    const Stage& stage_;
    BlocksInBox blocks_;
    int samples_;
    MemoryPicture picture_;
    CastView view_;
    ReliefPainter painter_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_relief_cast(const Stage& stage, BlocksInBox blocks, int samples) {
    Result<MemoryPicture> picture = MemoryPicture::create(stage);
    if (!picture) {
        return tl::unexpected<Error>(picture.error());
    }
    return std::make_unique<ReliefCast>(stage, std::move(blocks), samples, std::move(*picture));
}

BlocksInBox blocks_of_source(const SourceMesh& mesh, const PackDescription& pack, const PropShape& prop,
                             int texels) {
    const std::vector<glm::dvec3> points = in_box(mesh, pack.box_from_file);
    const SourceScene surface(mesh, points);
    const std::vector<ReliefDirection> directions = {ReliefDirection::PlusX, ReliefDirection::MinusX,
                                                     ReliefDirection::PlusY, ReliefDirection::MinusY,
                                                     ReliefDirection::PlusZ};
    return {bake_blocks({surface, pack.box_size, directions, texels}), pack.box_size,
            place(pack, prop).prop_from_artifact * glm::inverse(pack.box_from_file)};
}

} // namespace frustumscreen
