/// The folder of the installed set, as the importer reads and writes it: installed_set.h says what lies in it.
///
/// Order    packs are on the disk, under their names, before set.txt names them; what no set names goes only after the set
///          that named it has gone from the disk.
/// Threads  one caller.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/set_file.h"
#include "firmware_host/base/file_tree.h"

#include <optional>

namespace frustumscreen {

inline constexpr std::string_view incoming_file_name = "packs/incoming"; ///< a pack that is being copied
inline constexpr std::string_view next_set_file_name = "set.txt.new";

/// An empty one where there is none yet. Errors: it cannot be read, or is damaged.
[[nodiscard]] tl::expected<SetFile, ImportFailure> read_set_file(FileTree& library);
/// Nothing if there is none, or it is none: the exhibit has said nothing then. Errors: it cannot be read.
[[nodiscard]] tl::expected<std::optional<SetVerdict>, ImportFailure> read_verdict(FileTree& library);

/// Whether an installed pack's file is there and has its bytes: all of it is read.
[[nodiscard]] bool is_sound(FileTree& library, const InstalledPack& pack, std::size_t step_bytes);

/// Makes sure that what set.txt says now is on the disk, and that the folder for packs is.
[[nodiscard]] FileResult<void> settle(WritableTree& library);
/// Makes this the set, at once: the old one or this one is there at any time.
[[nodiscard]] FileResult<void> switch_to(WritableTree& library, const SetFile& file);
/// Removes the packs that `file`, which is on the disk, does not name. What cannot be removed stays until the next time.
void clear_away(WritableTree& library, const SetFile& file);

} // namespace frustumscreen
