/// A model's file in memory. A reader that goes through it from the beginning says how far it has come, and the memory
/// behind it is given back: the file and the mesh that is made of it never lie in memory whole together.
///
/// Errors   as read_file.
/// Threads  one.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace frustumscreen::bake {

/// Holds an OBJ of 60 million triangles, the most that a bake takes (mesh_assembly.h). The whole file lies in memory before
/// its reader begins: a file in mapped pages would end the program if it became shorter meanwhile.
inline constexpr std::uint64_t max_model_bytes = std::uint64_t{8} << 30U;

struct UnmapPages {
    std::size_t size = 0;
    void operator()(std::byte* memory) const;
};

class ModelFile {
public:
    [[nodiscard]] static Result<ModelFile> read(const std::filesystem::path& path);

    /// Zeros where the reader has passed.
    [[nodiscard]] ByteView bytes() const { return {memory_.get(), size_}; }
    /// The bytes before `offset` are not read any more.
    void passed(std::size_t offset);

private:
    std::unique_ptr<std::byte, UnmapPages> memory_; ///< pages of the system; null for an empty file
    std::size_t size_ = 0;
    std::size_t given_back_ = 0;
};

} // namespace frustumscreen::bake
