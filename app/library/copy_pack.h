/// One pack from the stick onto the kiosk's disk: copied, on the disk, checked, and only then under its name.
///
/// Checked  everything that is said of the pack afterwards comes from the copy, whose signature, manifest and parts were checked:
///          a stick that says other things the second time changes nothing.
/// Memory   a step, and what the pack's directory and manifest take.
/// Threads  one caller.
#pragma once

#include "app/library/stick_pack.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/file_tree.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace frustumscreen {

/// What is known of a pack once its signature was right.
[[nodiscard]] tl::expected<StickPack, ImportFailure> look_at_pack(FileTree& tree, const std::string& path,
                                                                  const PackTrust& trust);

/// What is heard while a pack is copied. A failure ends the work.
struct CopyEars {
    std::function<MonotonicTime()> now;
    /// So many bytes were read from the stick and written, and the reading took this long.
    std::function<std::optional<ImportFailure>(std::uint64_t bytes, Nanoseconds reading)> copied;
    /// So many bytes of the copy were checked, as a share of the file: all of them in the end.
    std::function<void(std::uint64_t bytes)> checked;
};

/// `pack`: as it was looked at. `step_bytes` are copied at a time. Its file and sha256 are filled in. The name is on the disk once
/// the folder of packs was synced.
[[nodiscard]] tl::expected<InstalledPack, ImportFailure>
copy_pack(FileTree& stick, WritableTree& library, const StickPack& pack, const PackTrust& trust,
          std::size_t step_bytes, const CopyEars& ears);

} // namespace frustumscreen
