/// exhibit.toml on a stick: which packs belong together, and in which order. It counts only with its signature, a
/// minisign file beside it.
///
/// Keys     order = ["id", ...], only = true, remove = ["id", ...], [attract] LANGUAGE = "text", [[key]] name, public_key, until.
/// Errors   the first one, as one line: file, line, key, what was found, what is allowed; for an unknown key, the
///          nearest known one.
/// Threads  pure; any.
#pragma once

#include "app/library/set_file.h"
#include "firmware_host/base/result.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::library {

inline constexpr std::string_view exhibit_file_name = "exhibit.toml";
inline constexpr std::string_view exhibit_signature_name = "exhibit.toml.minisig";
inline constexpr std::size_t max_exhibit_file_bytes = 64U << 10U;

struct ExhibitFile {
    std::vector<std::string>
        order;         ///< ids; these packs come first, and all of them must be installed or on the stick
    bool only = false; ///< packs that `order` does not name are removed
    std::vector<std::string> remove;                 ///< ids
    std::optional<std::vector<AttractText>> attract; ///< none: the texts stay as they are
    std::vector<CarriedKey> keys;
};
[[nodiscard]] Result<ExhibitFile> parse_exhibit_file(std::string_view text);

} // namespace frustumscreen::library
