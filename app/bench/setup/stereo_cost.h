/// The cost of a frame with two eyes' pictures over that of a frame without stereo, and over that of one eye's picture
/// alone in the layout's pixels: the default level and each relief of a pack, as the exhibit shows them.
///
/// Poses, cost, threads, errors   as frame_cost.h.
#pragma once

#include "app/bench/setup/frame_cost.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct StereoCost {
    std::string drawn; ///< "mesh", "relief192", ...
    settings::Stereo stereo = settings::Stereo::Off;
    double times_one_eye = 1.0;     ///< median frame time over that without stereo
    double cpu_times_one_eye = 1.0; ///< the same for the processor time of all threads
    double cpu_times_alone = 1.0;   ///< over the processor time of one eye's picture of this layout
};

/// Both eyes see one scene, so they should cost less than twice one eye.
inline constexpr double wanted_times_one_eye = 1.8;

[[nodiscard]] Result<std::vector<StereoCost>> stereo_costs(const settings::Settings& settings,
                                                           const pack::Pack& pack, const Progress& progress);
[[nodiscard]] std::string stereo_table(std::span<const StereoCost> costs);
[[nodiscard]] std::string stereo_csv(std::span<const StereoCost> costs);

} // namespace frustumscreen::bench
