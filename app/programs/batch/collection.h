/// A folder with many objects: each subfolder that has an `artifact.toml`, and each scan that lies there alone.
///
/// Errors   the folder is not there or cannot be read; a shard that is none.
/// Threads  any.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct BatchObject {
    std::string name; ///< its pack is NAME.fspack
    std::filesystem::path input;
    std::string fault; ///< why it cannot be baked at all, a sentence; else empty
};

struct Collection {
    std::vector<BatchObject> objects;     ///< by name, byte by byte
    std::vector<std::string> passed_over; ///< folders without an artifact.toml
};

/// Hidden folders and files are not looked at; nor is `output`, which may lie inside.
[[nodiscard]] Result<Collection> list_collection(const std::filesystem::path& folder,
                                                 const std::filesystem::path& output);

/// One of several machines' share.
struct Shard {
    std::size_t number = 1; ///< 1 to `of`
    std::size_t of = 1;
};
/// "3/8".
[[nodiscard]] Result<Shard> parse_shard(std::string_view text);
/// By a hash of each object's name: all shards together have each object once, also where objects come or go between the runs of
/// two shards.
[[nodiscard]] std::vector<BatchObject> share_of(std::span<const BatchObject> objects, const Shard& shard);

} // namespace frustumscreen
