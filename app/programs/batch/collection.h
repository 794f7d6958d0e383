/// A folder with many objects: each subfolder with an `artifact.toml`, and each single scan.
///
/// Errors   the folder is missing or unreadable; an invalid shard.
/// Threads  any.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

struct BatchObject {
    std::string name; ///< its pack is NAME.fspack
    std::filesystem::path input;
    std::string fault; ///< why it cannot be baked at all, a sentence; otherwise empty
};

struct Collection {
    std::vector<BatchObject> objects; ///< sorted by name, bytewise
    std::vector<std::string> skipped; ///< folders without an artifact.toml
};

/// Ignores hidden folders and files, and `output`, which may be inside `folder`.
[[nodiscard]] Result<Collection> list_collection(const std::filesystem::path& folder,
                                                 const std::filesystem::path& output);

/// The share of one of several machines.
struct Shard {
    std::size_t number = 1; ///< 1 to `of`
    std::size_t of = 1;
};
/// "3/8".
[[nodiscard]] Result<Shard> parse_shard(std::string_view text);
/// Selects by a hash of each object's name: all shards together contain each object once, even if objects are
/// added or removed between the runs of two shards.
[[nodiscard]] std::vector<BatchObject> share_of(std::span<const BatchObject> objects, const Shard& shard);

} // namespace frustumscreen::programs
