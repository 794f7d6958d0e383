/// The section `relief_blocks` of a pack: the artifact's layered relief at several resolutions, to be cast on the processor
/// (app/relief). Each lies in a part of its own, which is read only where something casts it.
///
/// Units    box, as LevelError.
/// Errors   one line: data that FORMAT.md does not allow; a part that is not what it should be. Messages of `load_...` begin with
///          the file's name. A pack without the section is no error: it has no relief.
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

namespace frustumscreen {

/// A relief as the manifest tells of it.
struct ReliefOutline {
    std::uint32_t texels = 0; ///< along the box's longest edge
    std::uint32_t blocks = 0;
    std::uint64_t bytes = 0; ///< of its part, unpacked
    LevelError error;        ///< measured as those of the levels
    std::string part;

    [[nodiscard]] bool operator==(const ReliefOutline&) const = default;
};
/// Coarse to fine; none without the section.
[[nodiscard]] Result<std::vector<ReliefOutline>> reliefs_of(const PackDescription& pack);

struct MeasuredRelief {
    BlockRelief relief;
    LevelError error;
};
/// Once for a pack; coarse to fine, none of them twice. Without any the section is left out.
void put_reliefs(Pack& pack, std::span<const MeasuredRelief> reliefs);

/// The one of this outline; nothing else is read but the manifest.
[[nodiscard]] Result<BlockRelief> load_relief(const std::filesystem::path& file, const ReliefOutline& relief);

/// The one of this outline, of a pack that was read whole.
[[nodiscard]] Result<BlockRelief> relief_of(const Pack& pack, const ReliefOutline& relief);

/// Holds the section against FORMAT.md; `pack` was read whole.
[[nodiscard]] Result<void> check_reliefs(const Pack& pack);

} // namespace frustumscreen
