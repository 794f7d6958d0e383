/// The set file of a stick with its signature, and what is remembered of it and of packs.
///
/// Threads  one caller; what reads no file is pure.
#pragma once

#include "app/library/exhibit_file.h"
#include "app/library/import_failure.h"
#include "app/library/stick_pack.h"
#include "firmware_host/base/file_tree.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen {

struct SignedExhibitFile {
    ExhibitFile file;
    std::uint64_t serial = 0; ///< 0: it is unsigned, and allowed
};

/// Nothing of the file is parsed before its signature was right. `highest`: the serial of the last one that was taken. Errors
/// concern the stick as a whole.
[[nodiscard]] tl::expected<SignedExhibitFile, ImportFailure>
read_signed_exhibit_file(FileTree& stick, const PackTrust& trust, std::uint64_t highest);

/// Behind those that are there.
void add_carried_keys(const std::vector<CarriedKey>& carried, std::vector<TrustedKey>& keys);

/// Keeps the serials of packs that are taken, the set file's, and its keys; a key that is there gets the new name and end.
void remember(SetFile& known, const std::vector<StickPack>& packs,
              const std::optional<SignedExhibitFile>& exhibit);

/// What a set that replaces the one of `choice` goes back to: that one if it was good, or if nothing is known to be better.
/// Without packs: those of the settings, as before the first set.
[[nodiscard]] InstalledSet set_to_go_back_to(const SetChoice& choice,
                                             const std::optional<SetVerdict>& verdict);

} // namespace frustumscreen
