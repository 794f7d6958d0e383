/// The set file of a stick with its signature.
///
/// Threads  one caller.
#pragma once

#include "app/library/exhibit_file.h"
#include "app/library/import_failure.h"
#include "app/library/set_file.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/file_tree.h"

#include <cstdint>
#include <optional>
#include <string>

namespace frustumscreen {

struct SignedExhibitFile {
    ExhibitFile file;
    std::optional<Signer> signer; ///< none: it is unsigned, and allowed
    std::string sha256;

    /// 0: it is unsigned.
    [[nodiscard]] std::uint64_t serial() const { return signer ? signer->serial : 0; }
};

/// Nothing of the file is parsed before its signature was right. `known`: what was taken before. Errors concern the stick as a
/// whole.
[[nodiscard]] tl::expected<SignedExhibitFile, ImportFailure>
read_signed_exhibit_file(FileTree& stick, const PackTrust& trust, const SetFile& known);

} // namespace frustumscreen
