/// Files that a model names: .bin, pictures, .mtl. Only those in the model's own folder or below it are read.
///
/// A name from another computer is accepted: backslashes, other capitalisation, another normal form, and a path that
/// leads elsewhere (C:\scans\skin.png), of which only the last part counts.
///
/// Errors   throws Refusal: an empty name, a missing or unreadable file.
#pragma once

#include "assets_baked/bake/loaders/load_notes.h"
#include "firmware_host/base/file.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bake {

class Sidecars {
public:
    /// `notes` receives files that were found under a different name than the model's.
    Sidecars(std::filesystem::path folder, LoadNotes& notes) : folder_(std::move(folder)), notes_(notes) {}

    /// Bytes of the file called `name` (plain, not percent-encoded). They are read again only if no caller holds them any
    /// more: sixteen large pictures do not fit into memory. A refusal's message begins with `place`.
    [[nodiscard]] std::shared_ptr<const Bytes> read(std::string_view name, std::string_view place);
    [[nodiscard]] bool exists(std::string_view name) const { return find(name).has_value(); }
    /// True if the whole path, not only its last part, leads to a file in the model's folder.
    [[nodiscard]] bool exists_as_written(std::string_view name) const;
    /// The folder of the file called `name`, relative to the model's folder.
    [[nodiscard]] std::filesystem::path folder_of(std::string_view name) const;
    /// A file beside the model that differs only in its ending from `name`: skin.jpg for skin.png.
    [[nodiscard]] std::optional<std::string> like(std::string_view name) const;

    /// Registers a file that the model names but that is not read, such as a normal map.
    void mention(std::string_view name);
    /// Every file that was read or mentioned, by its path.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

private:
    /// The path of the file that the model means by `name`.
    [[nodiscard]] std::optional<std::filesystem::path> find(std::string_view name) const;
    [[nodiscard]] std::optional<std::filesystem::path> find_as_written(std::string_view name) const;

    std::filesystem::path folder_;
    LoadNotes& notes_;
    std::map<std::filesystem::path, std::weak_ptr<const Bytes>> read_; ///< or mentioned
};

/// The last part of a path of any system.
[[nodiscard]] std::string_view last_part(std::string_view name);

/// Decodes %20 and other escapes into bytes (RFC 3986, 2.1).
[[nodiscard]] std::string percent_decoded(std::string_view uri, std::string_view place);
/// As percent_decoded; empty if a % is not followed by two hexadecimal digits.
[[nodiscard]] std::string percent_decoded_if_valid(std::string_view uri);

} // namespace frustumscreen::bake
