/// A small text file in the root of a stick, with its signature beside it in NAME.minisig.
///
/// Threads  one caller.
/// Errors   one sentence that begins with the file's name.
#pragma once

#include "app/library/import_failure.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::library {

struct SignedText {
    std::optional<std::string> text; ///< none: there is no such file
    std::optional<std::string> signature;
};
[[nodiscard]] tl::expected<SignedText, ImportFailure> read_signed_text(FileTree& stick, std::string_view name,
                                                                       std::size_t max_bytes);

/// The key that signed the file, which is not parsed. `today`: none: no key has expired.
[[nodiscard]] tl::expected<pack::Signer, ImportFailure> signer_of(std::string_view name,
                                                                  const SignedText& file,
                                                                  std::span<const pack::TrustedKey> keys,
                                                                  std::optional<std::chrono::sys_days> today);

[[nodiscard]] ImportFailure lower_serial(std::string_view name, std::uint64_t serial, std::uint64_t latest);

} // namespace frustumscreen::library
