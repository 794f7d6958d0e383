/// Why a stick as a whole, or one of its packs, is not taken: for the table as a value, for the staff as a sentence.
///
/// Threads  pure; any.
#pragma once

#include "app/library/import_report.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/file_tree.h"

#include <string>
#include <string_view>

namespace frustumscreen {

struct ImportFailure {
    ImportRefusal refusal = ImportRefusal::NotAPack;
    std::string reason;       ///< one sentence
    bool whole = false;       ///< the stick as a whole, not this pack alone
    bool by_set_file = false; ///< that is because of what the set file says
};

/// Something on the stick could not be read. A file or folder that is closed to us is one thing, a stick that fails another.
[[nodiscard]] ImportFailure stick_failure(std::string_view path, FileFault fault);
/// Something on the kiosk's disk could not be read or written.
[[nodiscard]] ImportFailure disk_failure(std::string_view path, FileFault fault);
[[nodiscard]] ImportFailure failure_of(const PackRefusal& refusal);
[[nodiscard]] ImportFailure failure_of(const SignatureRefusal& refusal);
/// The packs need `wanted` bytes, `free` are left, and `margin` of these stay free.
[[nodiscard]] ImportFailure no_room(std::uint64_t wanted, std::uint64_t free, std::uint64_t margin);
/// The new set is shown, and nobody knows whether it is on the disk.
[[nodiscard]] ImportFailure unsure_switch();
[[nodiscard]] ImportFailure too_slow();
[[nodiscard]] ImportFailure too_much(std::string reason);

} // namespace frustumscreen
