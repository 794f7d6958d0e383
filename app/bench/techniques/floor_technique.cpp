#include "app/bench/techniques/floor_technique.h"

#include "app/bench/techniques/floor.h"

#include <limits>

namespace frustumscreen {

namespace {

class FloorTechnique final : public Technique {
public:
    FloorTechnique(const Stage& stage, Floor floor) : stage_(stage), floor_(std::move(floor)) {}

    [[nodiscard]] std::string name() const override { return "floor"; }
    void draw(const BenchPose& pose) override {
        const ProjectorSettings& projector = stage_.settings.projector;
        floor_.draw(stage_.prop,
                    {projector.pinhole,
                     projector.table_from_projector,
                     pose.table_from_prop,
                     {&pose.eye_m, 1},
                     std::nullopt},
                    stage_.framebuffer);
    }
    /// It shows no artifact.
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose&) override {
        return ImageFloat(stage_.width(), stage_.height(),
                          glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }

private:
    const Stage& stage_;
    Floor floor_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_floor_technique(const Stage& stage) {
    Result<Floor> floor = Floor::create();
    if (!floor) {
        return tl::unexpected<Error>(floor.error());
    }
    return std::make_unique<FloorTechnique>(stage, std::move(*floor));
}

} // namespace frustumscreen
