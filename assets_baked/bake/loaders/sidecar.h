/// Files that a model names: .bin, pictures, .mtl. They must lie in the model's own folder or below it.
///
/// Errors   throws Refusal: a name that leaves the folder or has a scheme (http:, file:, C:), a file that is
///          missing or unreadable.
#pragma once

#include "firmware_host/base/file.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

class Sidecars {
public:
    explicit Sidecars(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Bytes of the file called `name` (plain, not percent-encoded). Each file is read once, however often it
    /// is named. `place` begins the message of a refusal.
    [[nodiscard]] std::shared_ptr<const Bytes> read(std::string_view name, std::string_view place);
    [[nodiscard]] bool exists(std::string_view name, std::string_view place) const;

    /// Notes a file that the model names but that is not read, such as a map of normals. A name that `read`
    /// would refuse is ignored.
    void mention(std::string_view name);
    /// Every file that was read or mentioned, by its path.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

private:
    [[nodiscard]] std::filesystem::path path_of(std::string_view name, std::string_view place) const;

    std::filesystem::path folder_;
    std::map<std::filesystem::path, std::shared_ptr<const Bytes>> read_; ///< null: only mentioned
};

/// Turns %20 and the like into bytes (RFC 3986, 2.1).
[[nodiscard]] std::string percent_decoded(std::string_view uri, std::string_view place);
/// The same; empty where a % is without two hexadecimal digits.
[[nodiscard]] std::string percent_decoded_if_valid(std::string_view uri);

} // namespace frustumscreen
