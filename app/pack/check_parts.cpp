#include "app/pack/check_parts.h"

#include "app/pack/check_pack.h"

#include <string>
#include <vector>

namespace frustumscreen {

namespace {

/// Every part that the manifest refers to, in no order.
std::vector<std::string> used_parts(const pack_format::Manifest& manifest) {
    std::vector<std::string> names = manifest.textures;
    if (manifest.relief) {
        names.push_back(manifest.relief->atlas);
        names.push_back(manifest.relief->charts);
    }
    for (const pack_format::LevelRecord& level : manifest.levels) {
        names.push_back(level.mesh);
    }
    if (!manifest.table_picture.empty()) {
        names.push_back(manifest.table_picture);
    }
    for (const PackSection& section : manifest.description.sections) {
        names.insert(names.end(), section.parts.begin(), section.parts.end());
    }
    return names;
}

} // namespace

Result<void> check_parts(pack_format::PackReader& reader,
                         const std::function<void(std::uint64_t bytes)>& progress) {
    const pack_format::Manifest& manifest = reader.manifest();
    if (Result<void> good = pack_format::check_description(manifest.description); !good) {
        return good;
    }
    if (Result<void> good = pack_format::check_level_count(manifest.description, manifest.levels.size());
        !good) {
        return good;
    }
    for (const std::string& name : used_parts(manifest)) {
        if (Result<void> good = reader.check(name, progress); !good) {
            return good;
        }
    }
    return reader.finish();
}

} // namespace frustumscreen
