#include "app/programs/preview/behaviour_pictures.h"

#include "app/programs/preview/front_pictures.h"

#include <array>

namespace frustumscreen::programs {

namespace {

constexpr int frames = 8;
constexpr double seconds_of_none = 1.0; ///< for a behaviour that states no time

Result<BehaviourPictures> draw(const std::filesystem::path& pack_file, const pack::PackBehaviour& behaviour,
                               const TurnOptions& options) {
    const std::string& name = behaviour.behaviour.name;
    const double seconds = behaviour.behaviour.seconds > 0.0 ? behaviour.behaviour.seconds : seconds_of_none;
    const double step_s = seconds / (frames - 1);
    std::array<double, frames> times_s{};
    for (int k = 0; k < frames; ++k) {
        times_s[static_cast<std::size_t>(k)] = k * step_s;
    }
    TRY(FrontPictures pictures,
        front_pictures(
            pack_file, options, [&](show::OfflineOptions& drawn) { drawn.behaviour = name; }, times_s,
            [&](double done) { options.progress("behaviour " + name, done); }));
    return BehaviourPictures{.behaviour = behaviour,
                             .frames = frames,
                             .step_s = step_s,
                             .size = pictures.size,
                             .sheet = std::move(pictures.sheet)};
}

} // namespace

Result<std::vector<BehaviourPictures>> behaviour_pictures(const std::filesystem::path& pack_file,
                                                          const TurnOptions& options) {
    TRY(const pack::PackWorld world, pack::load_world(pack_file));
    std::vector<BehaviourPictures> drawn;
    for (const pack::PackBehaviour& behaviour : world.behaviours) {
        TRY(BehaviourPictures pictures, draw(pack_file, behaviour, options));
        drawn.push_back(std::move(pictures));
    }
    return drawn;
}

} // namespace frustumscreen::programs
