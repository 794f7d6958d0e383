/// The pack as a file: one ZIP container with a manifest and hashed binary parts. FORMAT.md defines the bytes.
///
/// Errors   one line: what is wrong, where inside the pack, what to do. Every length, offset, count and
///          dimension is checked before use; no part is used before its hash is checked.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/pack/pack.h"
#include "app/pack/pack_outline.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>

namespace frustumscreen::pack {

/// The version that is written. Packs of all earlier versions are read.
inline constexpr int pack_format_version = 2;

class PackReader;

/// A pack whose parts were checked as they were read; only the functions below make one. Levels and textures
/// that were not chosen are empty but keep their places, so that indices are those of the file.
class VerifiedPack {
public:
    [[nodiscard]] const Pack& operator*() const { return pack_; }
    [[nodiscard]] const Pack* operator->() const { return &pack_; }

private:
    friend Result<VerifiedPack> read_pack(PackReader& reader, const ChooseLevels& choose);
    VerifiedPack() = default;
    Pack pack_;
};

/// Deterministic: equal packs give equal bytes.
[[nodiscard]] Result<Bytes> write_pack(const Pack& pack);
/// Without `choose`, reads all of it. Parts of levels that are not chosen are neither unpacked nor hashed.
[[nodiscard]] Result<VerifiedPack> verify_pack(std::span<const std::byte> bytes,
                                               const ChooseLevels& choose = {});
/// Reads and verifies part by part; a part that is not chosen is not read. Messages begin with the file's name.
[[nodiscard]] Result<VerifiedPack> load_pack(const std::filesystem::path& file,
                                             const ChooseLevels& choose = {});

/// As load_pack, from an open container: what was read before, such as its signature, is not read again. A reader
/// can be used once. Messages do not begin with the file's name.
[[nodiscard]] Result<VerifiedPack> read_pack(PackReader& reader, const ChooseLevels& choose = {});

/// `box_from_file` and the placement of the box in a prop as one matrix: file to prop coordinates.
struct Placement {
    double metres_per_box = 0.0; ///< uniform scale from box units to metres in the prop's frame
    glm::dmat4 prop_from_artifact{1.0};
};
[[nodiscard]] Placement place(const PackDescription& pack, const geometry::PropShape& prop);

} // namespace frustumscreen::pack
