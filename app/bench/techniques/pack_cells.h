/// The cells of a pack at rest, each in the quickest way that is good enough, as one picture: what the exhibit shows of a
/// pack whose cells are quicker than the whole.
///
/// Frames, cost, threads   as pack_level.h.
#pragma once

#include "app/bench/techniques/pack_level.h"

#include <filesystem>
#include <memory>
#include <string>

namespace frustumscreen::bench {

struct PackCells {
    std::unique_ptr<Technique> technique;
    std::string ways; ///< "part 1: relief384 of 1200 blocks, part 2: ..."
    std::uint64_t triangles = 0;
    std::uint64_t blocks = 0;
};

/// `whole`: the pack in `file`, which has cells.
[[nodiscard]] Result<PackCells> make_pack_cells(const Kiosk& kiosk, const std::filesystem::path& file,
                                                const pack::Pack& whole, const PictureOptions& options,
                                                std::string name);

} // namespace frustumscreen::bench
