/// The section `relief_blocks` of a pack: the artifact's layered relief at several resolutions, to be rasterized on
/// the processor (app/relief). Each relief has a part of its own, which is read only for that purpose.
///
/// Units    box, as LevelError.
/// Errors   one line: data that FORMAT.md does not allow; a part that contradicts the manifest. Messages of
///          `load_...` begin with the file's name. A pack without the section is no error: it has no relief.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "app/relief/block_relief.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::pack {

/// A relief as the manifest describes it.
struct ReliefOutline {
    std::uint32_t texels = 0; ///< along the box's longest edge
    std::uint32_t blocks = 0;
    std::uint64_t bytes = 0; ///< of its part, unpacked
    LevelError error;        ///< measured like those of the levels
    std::string part;

    [[nodiscard]] bool operator==(const ReliefOutline&) const = default;
};
/// Coarse to fine; empty without the section.
[[nodiscard]] Result<std::vector<ReliefOutline>> reliefs_of(const PackDescription& pack);

struct MeasuredRelief {
    relief::BlockRelief relief;
    LevelError error;
};
/// Call once for a pack; coarse to fine, each resolution once. Without reliefs the section is left out.
void put_reliefs(Pack& pack, std::span<const MeasuredRelief> reliefs);

/// Loads the relief of this outline; reads only its part and the manifest.
[[nodiscard]] Result<relief::BlockRelief> load_relief(const std::filesystem::path& file,
                                                      const ReliefOutline& relief);

/// The relief of this outline, of a pack that was read whole.
[[nodiscard]] Result<relief::BlockRelief> relief_of(const Pack& pack, const ReliefOutline& relief);

/// Checks the section against FORMAT.md; `pack` was read whole.
[[nodiscard]] Result<void> check_reliefs(const Pack& pack);

} // namespace frustumscreen::pack
