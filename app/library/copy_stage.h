/// Copies a stick's packs to the kiosk's disk, one after the other, the newest of each artifact first, within the
/// import's limits.
///
/// Memory   as copy_pack.h.
/// Threads  one caller.
/// Errors   those of the stick as a whole are returned; those of one pack are in its line.
#pragma once

#include "app/library/copy_pack.h"
#include "app/library/import_costs.h"
#include "app/library/import_stick.h"
#include "app/library/stick_pack.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace frustumscreen::library {

class CopyStage {
public:
    /// The references must outlive the stage. `progress` gets the bytes done: each byte of a pack counts twice,
    /// copied and checked.
    CopyStage(FileTree& stick, WritableTree& library, const ImportLimits& limits,
              const ImportEnvironment& outside, WastedWorkBudget& in_vain,
              std::function<void(std::uint64_t bytes)> progress)
        : stick_(stick), library_(library), limits_(limits), outside_(outside), in_vain_(in_vain),
          progress_(std::move(progress)), pace_(limits) {}

    /// Takes or refuses each wanted pack. At the end, the names of the taken packs are on the disk.
    [[nodiscard]] ImportResult<void> run(std::vector<StickPack>& packs, const pack::PackTrust& trust);

private:
    ImportResult<void> copy(StickPack& pack, const pack::PackTrust& trust);
    void add(std::uint64_t bytes);

    FileTree& stick_;
    WritableTree& library_;
    const ImportLimits& limits_;
    const ImportEnvironment& outside_;
    WastedWorkBudget& in_vain_;
    std::function<void(std::uint64_t bytes)> progress_;
    ReadingPace pace_;
    std::uint64_t done_bytes_ = 0;
};

} // namespace frustumscreen::library
