/// Why a stick, or one of its packs, is refused: a value for the table, a sentence for the staff.
///
/// Threads  pure; any.
#pragma once

#include "app/library/import_report.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/file_tree.h"

#include <string>
#include <string_view>
#include <utility>

namespace frustumscreen::library {

struct ImportFailure {
    ImportRefusal refusal = ImportRefusal::NotAPack;
    std::string reason;       ///< one sentence
    bool whole = false;       ///< concerns the whole stick, not only this pack
    bool by_set_file = false; ///< it follows from what the set file says
};

template <typename T> using ImportResult = tl::expected<T, ImportFailure>;

[[nodiscard]] inline tl::unexpected<ImportFailure> failed(ImportFailure failure) {
    return tl::unexpected<ImportFailure>(std::move(failure));
}

/// A part of the stick could not be read. A file without read permission and a failing stick have different
/// sentences.
[[nodiscard]] ImportFailure stick_failure(std::string_view path, FileFault fault);
/// A file on the kiosk's disk could not be read or written.
[[nodiscard]] ImportFailure disk_failure(std::string_view path, FileFault fault);
[[nodiscard]] ImportFailure failure_of(const pack::PackRefusal& refusal);
[[nodiscard]] ImportFailure failure_of(const pack::SignatureRefusal& refusal);
/// The packs need `wanted` bytes; `free` are left, of which `margin` must stay free.
[[nodiscard]] ImportFailure no_space(std::uint64_t wanted, std::uint64_t free, std::uint64_t margin);
/// The new set is shown, but may not be on the disk.
[[nodiscard]] ImportFailure unsure_switch();
[[nodiscard]] ImportFailure too_slow();
[[nodiscard]] ImportFailure too_much(std::string reason);

} // namespace frustumscreen::library
