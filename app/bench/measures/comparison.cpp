#include "app/bench/measures/comparison.h"

#include "app/bench/truth/lit_source.h"

namespace frustumscreen::bench {

Result<Comparison> open_comparison(const SetUp& set_up, const pack::Pack& pack,
                                   std::span<const std::uint32_t> levels,
                                   const std::shared_ptr<const bake::SourceMesh>& mesh,
                                   const ComparisonOptions& options) {
    TRY(std::unique_ptr<TechniqueSet> set, TechniqueSet::open(set_up));
    const geometry::PropShape& prop = set->kiosk().prop;
    TRY(std::vector<BenchPose> poses, draw_poses(set_up.settings, prop, options.poses, options.seed));
    const glm::dmat4 prop_from_artifact = pack::place(pack, prop).prop_from_artifact;
    TRY(Truth truth, Truth::build(mesh, prop_from_artifact));
    if (!pack.unlit) {
        truth.light_by(std::make_shared<const LitSource>(mesh, pack.box_from_file));
    }
    for (const std::uint32_t level : levels) {
        TRY_VOID(set->add_level(pack, level, options.picture));
    }
    return Comparison{.set = std::move(set),
                      .poses = std::move(poses),
                      .truth = std::move(truth),
                      .prop_from_artifact = prop_from_artifact};
}

std::vector<std::uint32_t> default_and_finest(const pack::Pack& pack) {
    const auto finest = static_cast<std::uint32_t>(pack.levels.size() - 1);
    return pack.default_level == finest ? std::vector{finest} : std::vector{pack.default_level, finest};
}

} // namespace frustumscreen::bench
