#include "app/bench/setup/stereo_cost.h"

#include "app/pack/pack_relief.h"
#include "app/scene/stereo.h"

#include <fmt/format.h>

#include <array>

namespace frustumscreen::bench {

namespace {

constexpr std::array layouts{settings::Stereo::SideBySide, settings::Stereo::TopBottom,
                             settings::Stereo::FrameSequential, settings::Stereo::Anaglyph};

settings::Settings in_layout(settings::Settings settings, settings::Stereo stereo) {
    settings.eye.stereo = stereo;
    settings.projector.stereo = settings::OutputStereo::AsEye;
    return settings;
}

/// Without stereo; then, for each layout, one eye's picture alone and both eyes.
std::vector<settings::Settings> set_ups_of(const settings::Settings& settings) {
    std::vector<settings::Settings> all{in_layout(settings, settings::Stereo::Off)};
    for (const settings::Stereo stereo : layouts) {
        settings::Settings& alone = all.emplace_back(all.front());
        alone.projector.pinhole = scene::stereo_layout(settings.projector.pinhole, stereo).pinhole;
        all.push_back(in_layout(settings, stereo));
    }
    return all;
}

} // namespace

Result<std::vector<StereoCost>> stereo_costs(const settings::Settings& settings, const pack::Pack& pack,
                                             const Progress& progress) {
    const std::vector<settings::Settings> set_ups = set_ups_of(settings);
    std::vector<const settings::Settings*> pointers;
    for (const settings::Settings& each : set_ups) {
        pointers.push_back(&each);
    }
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack));
    std::vector<StereoCost> costs;
    for (std::size_t part = 0; part <= reliefs.size(); ++part) {
        std::string drawn = "mesh";
        std::shared_ptr<const relief::BlockRelief> relief;
        if (part > 0) {
            TRY(relief::BlockRelief loaded, pack::relief_of(pack, reliefs[part - 1]));
            relief = std::make_shared<const relief::BlockRelief>(std::move(loaded));
            drawn = fmt::format("relief{}", reliefs[part - 1].texels);
        }
        const auto shown = [&](double done) {
            progress((static_cast<double>(part) + done) / static_cast<double>(reliefs.size() + 1));
        };
        TRY(const std::vector<SetUpCost> measured, frame_costs(pointers, pack, shown, relief));
        for (std::size_t k = 0; k < layouts.size(); ++k) {
            const SetUpCost& alone = measured[1 + 2 * k];
            const SetUpCost& both = measured[2 + 2 * k];
            costs.push_back({.drawn = drawn,
                             .stereo = layouts[k],
                             .times_one_eye = both.times_first,
                             .cpu_times_one_eye = both.cpu_times_first,
                             .cpu_times_alone = both.cpu_times_first / alone.cpu_times_first});
        }
    }
    return costs;
}

std::string stereo_table(std::span<const StereoCost> costs) {
    std::string text = fmt::format("{:<10} {:<18} {:>16} {:>16} {:>16}\n", "drawn", "layout",
                                   "time / one eye", "processor time", "/ its eye alone");
    for (const StereoCost& cost : costs) {
        text += fmt::format("{:<10} {:<18} {:>16.2f} {:>16.2f} {:>16.2f}{}\n", cost.drawn,
                            settings::name_of(cost.stereo), cost.times_one_eye, cost.cpu_times_one_eye,
                            cost.cpu_times_alone,
                            cost.cpu_times_one_eye > wanted_times_one_eye ? "  more than wanted" : "");
    }
    return text;
}

std::string stereo_csv(std::span<const StereoCost> costs) {
    std::string text = "drawn,layout,times_one_eye,cpu_times_one_eye,cpu_times_alone\n";
    for (const StereoCost& cost : costs) {
        text += fmt::format("{},{},{:.4f},{:.4f},{:.4f}\n", cost.drawn, settings::name_of(cost.stereo),
                            cost.times_one_eye, cost.cpu_times_one_eye, cost.cpu_times_alone);
    }
    return text;
}

} // namespace frustumscreen::bench
