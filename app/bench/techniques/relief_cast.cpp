#include "app/bench/techniques/relief_cast.h"

#include "app/bench/techniques/memory_picture.h"
#include "app/pack/pack_file.h"
#include "app/relief/cast_blocks.h"
#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/box_frame.h"
#include "firmware_host/base/parallel.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

class ReliefCast final : public Technique {
public:
    ReliefCast(const Stage& stage, BlocksInBox blocks, MemoryPicture picture)
        : stage_(stage), blocks_(std::move(blocks)), picture_(std::move(picture)) {
        cast_.resize(stage.width(), stage.height());
    }

    [[nodiscard]] std::string name() const override {
        return fmt::format("relief cast {:.0f}", 1.0F / blocks_.relief.texel_box);
    }
    void draw(const BenchPose& pose) override {
        cast_picture(pose);
        picture_.show(stage_, view_.lit);
    }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        cast_picture(pose);
        ImageFloat points(stage_.width(), stage_.height(),
                          glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        for (int y = view_.lit.y; y < view_.lit.y + view_.lit.height; ++y) {
            for (int x = view_.lit.x; x < view_.lit.x + view_.lit.width; ++x) {
                const std::size_t at = cast_.at(x, y);
                if (std::isfinite(cast_.t[at])) {
                    points.at(x, y) =
                        glm::vec3(point_at({x + 0.5, y + 0.5, 1.0}, static_cast<double>(cast_.t[at])));
                }
            }
        }
        return points;
    }

private:
    void cast_picture(const BenchPose& pose) {
        const TruthView view = view_of(stage_.settings, pose);
        set_up(
            view_, stage_.prop,
            {blocks_.prop_from_box, blocks_.box_size, view.projector, view.prop_from_projector, view.eye_m});
        list_blocks(items_, blocks_.relief, view_);
        const int first = view_.lit.y / tile_height;
        const int rows = (view_.lit.y + view_.lit.height + tile_height - 1) / tile_height - first;
        parallel_for(static_cast<std::size_t>(std::max(rows, 0)), 16,
                     [&](std::size_t begin, std::size_t end) {
                         const TileBand band{first + static_cast<int>(begin), first + static_cast<int>(end)};
                         cast(cast_, blocks_.relief, view_, items_, band);
                         shade(band);
                     });
    }

    void shade(const TileBand& band) {
        const int end = std::min(band.end * tile_height, view_.lit.y + view_.lit.height);
        for (int y = std::max(band.first * tile_height, view_.lit.y); y < end; ++y) {
            for (int x = view_.lit.x; x < view_.lit.x + view_.lit.width; ++x) {
                const std::size_t at = cast_.at(x, y);
                if (cast_.t[at] < std::numeric_limits<float>::infinity()) {
                    picture_.codes.at(x, y) = colour_at(blocks_.relief, cast_.block[at], cast_.place[at]);
                }
            }
        }
    }

    [[nodiscard]] glm::dvec3 point_at(const glm::dvec3& pixel, double t) const {
        for (const CastFace& face : view_.faces) {
            if (std::all_of(face.edges.begin(), face.edges.end(),
                            [&pixel](const glm::dvec3& edge) { return glm::dot(edge, pixel) > -1e-3; })) {
                const glm::dvec3 box = view_.eye_box + t * (face.direction * pixel);
                return {blocks_.prop_from_box * glm::dvec4(box, 1.0)};
            }
        }
        return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }

    const Stage& stage_;
    BlocksInBox blocks_;
    MemoryPicture picture_;
    CastView view_;
    BlockItems items_;
    CastPicture cast_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_relief_cast(const Stage& stage, BlocksInBox blocks) {
    Result<MemoryPicture> picture = MemoryPicture::create(stage);
    if (!picture) {
        return tl::unexpected<Error>(picture.error());
    }
    return std::make_unique<ReliefCast>(stage, std::move(blocks), std::move(*picture));
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
