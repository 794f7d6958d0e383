/// A stick's packs onto the kiosk's disk, one after the other, the newest of an artifact first; what this may cost is bounded.
///
/// Memory   as copy_pack.h.
/// Threads  one caller.
/// Errors   what concerns the stick as a whole; what concerns one pack stands in its line.
#pragma once

#include "app/library/copy_pack.h"
#include "app/library/import_costs.h"
#include "app/library/import_stick.h"
#include "app/library/stick_pack.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace frustumscreen {

class CopyStage {
public:
    /// All are used until it ends. `progress` hears how many bytes are done: each byte of a pack is copied, and checked.
    CopyStage(FileTree& stick, WritableTree& library, const ImportLimits& limits,
              const ImportSurroundings& outside, WorkInVain& in_vain,
              std::function<void(std::uint64_t bytes)> progress)
        : stick_(stick), library_(library), limits_(limits), outside_(outside), in_vain_(in_vain),
          progress_(std::move(progress)), pace_(limits) {}

    /// Those that are wanted are taken or refused, and their names are on the disk.
    [[nodiscard]] tl::expected<void, ImportFailure> run(std::vector<StickPack>& packs,
                                                        const PackTrust& trust);

private:
    tl::expected<void, ImportFailure> copy(StickPack& pack, const PackTrust& trust);
    void add(std::uint64_t bytes);

    FileTree& stick_;
    WritableTree& library_;
    const ImportLimits& limits_;
    const ImportSurroundings& outside_;
    WorkInVain& in_vain_;
    std::function<void(std::uint64_t bytes)> progress_;
    ReadingPace pace_;
    std::uint64_t done_bytes_ = 0;
};

} // namespace frustumscreen
