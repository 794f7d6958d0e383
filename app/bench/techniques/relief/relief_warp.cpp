#include "app/bench/techniques/relief/relief_warp.h"

#include "app/bench/techniques/peers.h"
#include "app/bench/techniques/relief/relief_mesh.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

namespace {

class Warp final : public Technique {
public:
    Warp(std::unique_ptr<PeerMesh> mesh, std::unique_ptr<Technique> drawn, std::string name)
        : mesh_(std::move(mesh)), drawn_(std::move(drawn)), name_(std::move(name)) {}
    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const BenchPose& pose) override { drawn_->draw(pose); }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        return drawn_->hit_points(pose);
    }

private:
    std::unique_ptr<PeerMesh> mesh_; ///< first: what is drawn refers to it
    std::unique_ptr<Technique> drawn_;
    std::string name_;
};

} // namespace

Result<ReliefWarp> make_relief_warp(const Stage& stage, const ReliefImages& images) {
    const SourceMesh mesh = single_layer_mesh(images, single_layer_tolerance_m);
    Result<std::unique_ptr<PeerMesh>> uploaded = PeerMesh::upload(mesh, glm::dmat4(1.0));
    if (!uploaded) {
        return tl::unexpected<Error>(uploaded.error());
    }
    (*uploaded)->leave_out_backs();
    Result<std::unique_ptr<Technique>> drawn = make_full_mesh(stage, **uploaded);
    if (!drawn) {
        return tl::unexpected<Error>(drawn.error());
    }
    return ReliefWarp{std::make_unique<Warp>(std::move(*uploaded), std::move(*drawn),
                                             fmt::format("relief warp {}", images.texels)),
                      mesh.triangles.size()};
}

} // namespace frustumscreen
