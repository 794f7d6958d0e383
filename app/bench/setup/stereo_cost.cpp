#include "app/bench/setup/stereo_cost.h"

#include "app/pack/pack_relief.h"

#include <fmt/format.h>

#include <array>

namespace frustumscreen::bench {

namespace {

/// Without stereo, then each layout.
std::vector<settings::Settings> with_each_layout(const settings::Settings& settings) {
    std::vector<settings::Settings> all;
    for (const settings::Stereo stereo :
         {settings::Stereo::Off, settings::Stereo::SideBySide, settings::Stereo::TopBottom,
          settings::Stereo::FrameSequential, settings::Stereo::Anaglyph}) {
        all.push_back(settings);
        all.back().eye.stereo = stereo;
        all.back().projector.stereo = settings::ProjectorStereo::AsEye;
    }
    return all;
}

} // namespace

Result<std::vector<StereoCost>> stereo_costs(const settings::Settings& settings, const pack::Pack& pack,
                                             const Progress& progress) {
    const std::vector<settings::Settings> set_ups = with_each_layout(settings);
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
        for (std::size_t k = 1; k < measured.size(); ++k) {
            costs.push_back({.drawn = drawn,
                             .stereo = set_ups[k].eye.stereo,
                             .times_one_eye = measured[k].times_first,
                             .cpu_times_one_eye = measured[k].cpu_times_first});
        }
    }
    return costs;
}

std::string stereo_table(std::span<const StereoCost> costs) {
    std::string text =
        fmt::format("{:<10} {:<18} {:>16} {:>16}\n", "drawn", "layout", "time / one eye", "processor time");
    for (const StereoCost& cost : costs) {
        text += fmt::format("{:<10} {:<18} {:>16.2f} {:>16.2f}{}\n", cost.drawn,
                            settings::name_of(cost.stereo), cost.times_one_eye, cost.cpu_times_one_eye,
                            cost.cpu_times_one_eye > wanted_times_one_eye ? "  more than wanted" : "");
    }
    return text;
}

std::string stereo_csv(std::span<const StereoCost> costs) {
    std::string text = "drawn,layout,times_one_eye,cpu_times_one_eye\n";
    for (const StereoCost& cost : costs) {
        text += fmt::format("{},{},{:.4f},{:.4f}\n", cost.drawn, settings::name_of(cost.stereo),
                            cost.times_one_eye, cost.cpu_times_one_eye);
    }
    return text;
}

} // namespace frustumscreen::bench
