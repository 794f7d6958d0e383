#include "app/library/copy_stage.h"

#include "app/library/library_folder.h"

#include <string>

namespace frustumscreen::library {

ImportResult<void> CopyStage::run(std::vector<StickPack>& packs, const pack::PackTrust& trust) {
    std::uint64_t decided_bytes = 0; // whole packs, even if their copy ended early
    for (const std::size_t k : copy_order(packs)) {
        StickPack& pack = packs[k];
        if (!pack.is_wanted()) {
            continue;
        }
        decided_bytes += 2 * pack.pack.bytes;
        weigh_against_taken(pack, packs);
        if (pack.is_wanted()) {
            TRY_VOID(copy(pack, trust));
        }
        done_bytes_ = decided_bytes;
    }
    const FileResult<void> synced =
        decided_bytes > 0 ? library_.sync_folder(std::string(packs_folder_name)) : FileResult<void>();
    return synced ? ImportResult<void>() : failed(disk_failure(packs_folder_name, synced.error()));
}

void CopyStage::add(std::uint64_t bytes) {
    done_bytes_ += bytes;
    progress_(done_bytes_);
}

ImportResult<void> CopyStage::copy(StickPack& pack, const pack::PackTrust& trust) {
    if (in_vain_.is_hopeless(pack.pack.manifest_sha256)) {
        refuse(pack.told,
               {.refusal = ImportRefusal::Altered,
                .reason = "it was not tried, because other copies of this pack on the stick are damaged; "
                          "put one whole copy on the stick",
                .whole = false});
        return {};
    }
    const auto on_copied = [this](std::uint64_t bytes, Nanoseconds reading) {
        add(bytes);
        return pace_.add(bytes, reading) ? std::nullopt : std::optional(too_slow());
    };
    const CopyObserver ears{outside_.now, on_copied, [this](std::uint64_t bytes) { add(bytes); }};
    const Nanoseconds before = outside_.work();
    const tl::expected<InstalledPack, ImportFailure> copied =
        copy_pack(stick_, library_, pack, trust, limits_.step_bytes, ears);
    if (copied) {
        pack.pack = *copied;
        pack.told.outcome = ImportOutcome::Taken;
        return {};
    }
    if (copied.error().whole) {
        return failed(copied.error());
    }
    refuse(pack.told, copied.error());
    in_vain_.add_copy(outside_.work() - before, pack.pack.manifest_sha256);
    return in_vain_.is_too_much()
               ? failed(too_much("many packs on the stick are damaged; copy them onto another stick"))
               : ImportResult<void>();
}

} // namespace frustumscreen::library
