/// A stick's set file with its signature.
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

namespace frustumscreen::library {

struct SignedExhibitFile {
    ExhibitFile file;
    std::optional<pack::Signer> signer; ///< none: unsigned, which is allowed
    std::string sha256;

    /// 0: unsigned.
    [[nodiscard]] std::uint64_t serial() const { return signer ? signer->serial : 0; }
};

/// Parses the file only after its signature is checked. `known`: what was taken before. Errors concern the stick as
/// a whole.
[[nodiscard]] tl::expected<SignedExhibitFile, ImportFailure>
read_signed_exhibit_file(FileTree& stick, const pack::PackTrust& trust, const SetFile& known);

} // namespace frustumscreen::library
