/// The folder of the installed set, as the importer reads and writes it. installed_set.h describes its files.
///
/// Order    packs are on the disk, under their names, before set.txt names them. A pack is removed only after the
///          last set that names it is gone from the disk.
/// Threads  one caller.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/set_file.h"
#include "firmware_host/base/file_tree.h"

#include <optional>

namespace frustumscreen::library {

inline constexpr std::string_view incoming_file_name = "packs/incoming"; ///< a pack that is being copied
inline constexpr std::string_view next_set_file_name = "set.txt.new";

/// Returns an empty one if there is none yet. Errors: it cannot be read, or is damaged.
[[nodiscard]] tl::expected<SetFile, ImportFailure> read_set_file(FileTree& library);
/// Nothing if there is no verdict, or the file is no verdict: the exhibit has not judged. Errors: the file cannot
/// be read.
[[nodiscard]] tl::expected<std::optional<SetVerdict>, ImportFailure> read_verdict(FileTree& library);

/// True if an installed pack's file is there and undamaged: all of it is read.
[[nodiscard]] bool is_sound(FileTree& library, const InstalledPack& pack, std::size_t step_bytes);

/// Makes sure that set.txt as it reads now, and the folder for packs, are on the disk.
[[nodiscard]] FileResult<void> settle(WritableTree& library);
/// Installs this set in one step: at any time, either the old or the new one is there.
[[nodiscard]] FileResult<void> switch_to(WritableTree& library, const SetFile& file);
/// Removes the packs that `file`, which is on the disk, does not name. Files that cannot be removed stay until the
/// next import.
void clear_away(WritableTree& library, const SetFile& file);

} // namespace frustumscreen::library
