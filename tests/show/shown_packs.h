/// Packs in a folder of their own, each with rings at two levels and its own colour; removed at the end.
#pragma once

#include "app/pack/pack_file.h"
#include "app/residency/prepared_artifact.h"
#include "tests/base/temporary_folder.h"
#include "tests/render/synthetic_pack.h"
#include "tests/settings/steep_table.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

namespace frustumscreen::synthetic {

/// Rings at two levels, white except for one channel that encodes the number.
inline pack::Pack numbered_pack(std::size_t number) {
    pack::Pack pack = rings(24, 12);
    const pack::Pack coarse = rings(12, 4);
    pack.levels.insert(pack.levels.begin(), coarse.levels[0]);
    pack.levels[0].error = {4e-3F, 2e-2F, 4e-2F, 0.0F};
    pack.levels[1].error = {3e-4F, 1e-3F, 4e-3F, 0.0F};
    pack.textures[0] = image::Image8(64, 64, {250, 250, static_cast<std::uint8_t>(20 * number), 255});
    pack.title = fmt::format("Rings {}", number);
    complete(pack);
    pack.samples = 1;
    return pack;
}

class ShownPacks {
public:
    explicit ShownPacks(std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) {
            files_.push_back(folder_.path() / fmt::format("{}.fspack", k));
            static_cast<void>(write_file(files_.back(), pack::write_pack(numbered_pack(k)).value()));
        }
    }

    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
    /// Damages the colours, which every level needs; the manifest stays intact.
    void damage(std::size_t number) const {
        Bytes bytes = read_file(files_[number], 1U << 24U).value();
        const std::size_t name = as_text(bytes).find("textures/0");
        bytes[name + 32] ^= std::byte{0x40}; // inside the data that follow the name
        static_cast<void>(write_file(files_[number], bytes));
    }
    [[nodiscard]] residency::KnownArtifact known(std::size_t number) const {
        residency::KnownArtifact known{files_[number], pack::outline_of(numbered_pack(number)), {}};
        known.plan = scene::plan_scene(settings::steep_table(), known.outline, {}).value();
        return known;
    }

private:
    TemporaryFolder folder_;
    std::vector<std::filesystem::path> files_;
};

} // namespace frustumscreen::synthetic
