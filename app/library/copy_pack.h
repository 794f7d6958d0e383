/// Copies one pack from the stick to the kiosk's disk, syncs it, checks it, and only then gives it its name.
///
/// Checked  everything reported of the pack afterwards comes from the copy, whose signature, manifest and parts
///          were checked. A stick that returns other bytes on a second read changes nothing.
/// Memory   one step, and the pack's directory and manifest.
/// Threads  one caller.
#pragma once

#include "app/library/stick_pack.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/file_tree.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace frustumscreen::library {

/// Opens a pack on the stick, checks its signature and returns what is known of it.
[[nodiscard]] tl::expected<StickPack, ImportFailure> look_at_pack(FileTree& tree, const std::string& path,
                                                                  const pack::PackTrust& trust);

/// Callbacks during a copy. A failure ends the copy.
struct CopyObserver {
    std::function<MonotonicTime()> now;
    /// `bytes` were read from the stick and written; `reading` is the time of the reads.
    std::function<std::optional<ImportFailure>(std::uint64_t bytes, Nanoseconds reading)> copied;
    /// `bytes` of the copy were checked; the calls add up to the whole file.
    std::function<void(std::uint64_t bytes)> checked;
};

/// Copies `step_bytes` at a time. `pack`: as look_at_pack returned it; the result has its file and sha256 too. The
/// name is on the disk once the folder of packs is synced.
[[nodiscard]] tl::expected<InstalledPack, ImportFailure>
copy_pack(FileTree& stick, WritableTree& library, const StickPack& pack, const pack::PackTrust& trust,
          std::size_t step_bytes, const CopyObserver& ears);

} // namespace frustumscreen::library
