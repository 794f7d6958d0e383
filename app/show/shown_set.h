/// The artifacts that are shown together, with everything that belongs to them: what is in memory, their pictures on
/// the table, and the exhibit's own texts in their languages.
///
///     open_set (any thread) -> upload, a part a frame -> shown -> release, a part a frame -> destroyed (any thread)
///
/// Memory   while one set is shown and another is loaded, both are in memory: the new one adds its first artifact's
///          levels, the caption, all small pictures and texts. Budgets count each set alone.
/// Threads  `open_set` on any, without a context. `upload` and `release_some` on the render thread, with the
///          display's context current. A set with nothing in the store may be destroyed on any thread; the destructor
///          may wait for its reader.
/// Errors   as open_artifacts; the driver has no memory.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/gpu_store.h"
#include "app/residency/artifact_cache.h"
#include "app/residency/artifact_opener.h"
#include "app/residency/loaded.h"
#include "app/residency/torch_contents.h"
#include "app/scene/device_plan.h"
#include "app/scene/frame_plan.h"
#include "app/scene/frame_time_model.h"
#include "app/scene/scene_plan.h"
#include "app/settings/settings.h"
#include "app/show/advice_words.h"
#include "app/show/show.h"
#include "app/show/table_show.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::show {

/// Options common to all sets of a run.
struct SetOptions {
    std::string technique =
        "auto"; ///< `technique`, `samples`, `cull_kinds`, `program` and `waits`: as ArtifactShowOptions
    int samples = 1;
    unsigned cull_kinds = scene::AllCullKinds;
    std::string_view program = "frustumscreen";
    bool waits = false;
    scene::DevicePlan devices;
    std::uint32_t max_blocks_on_gpu = 0;   ///< as SceneRequest
    std::uint64_t gpu_bytes_that_stay = 0; ///< part of the memory's budget that every set needs
};
struct SetRequest {
    std::uint64_t number = 0; ///< as InstalledSet; 0: the packs of the settings or of the command line
    std::vector<std::filesystem::path> packs;
    std::string packs_key; ///< as ArtifactShowOptions
    std::vector<AttractLine> attract;
    std::function<bool()> goes_on = [] { return true; }; ///< called before each pack; false ends opening
};
/// The cost of frames on this GPU, and the view that they are expected for.
struct ExpectedFrames {
    scene::FrameCost cost;
    geometry::PropShape prop;
    scene::PlanView view;
    glm::dvec3 eye_m{0.0};
};

struct ShownSet {
    std::uint64_t number = 0;
    exhibit::Catalogue catalogue; ///< as opened; the exhibit has its own
    std::vector<std::string>
        names; ///< by artifact: its id, or its file without one; equal names in two sets mean the same artifact
    std::vector<ArtifactInProp> in_prop; ///< by artifact
    std::vector<std::string> languages;  ///< of all captions
    std::string trouble;                 ///< why the set cannot be shown; empty: it can
    std::vector<std::string> notes;      ///< sentences about settings that may be unintended
    scene::RenderNeeds needs;
    std::unique_ptr<residency::ArtifactCache> artifact_cache;
    std::unique_ptr<residency::TorchContents>
        torch_contents; ///< null: there is no torch and no state with a layer
    AdviceWords words;
    residency::LoadedTexts word_pictures;
    TableShow table;
    std::optional<exhibit::TableBrowser>
        browser; ///< from lay_out_catalogue; the exhibit takes it. A run's first set has none

    /// Uploads about `max_bytes` more of what `request` needs to be shown, or a little more.
    [[nodiscard]] Result<void> upload(render::GpuStore& store, const residency::CacheRequest& request,
                                      std::uint64_t max_bytes);
    [[nodiscard]] bool ready(const residency::CacheRequest& request) const;
    /// Releases a part of the store's contents. False: nothing is left in the store. After the first call nothing can
    /// be shown.
    bool release_some(render::GpuStore& store);

    [[nodiscard]] scene::TextureId word(const exhibit::WordIndex& word, std::size_t shape) const;
    [[nodiscard]] residency::SharedRecording recording(const exhibit::WordIndex& word) const;
    /// True if anything of the set can be heard.
    [[nodiscard]] bool speaks() const;
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const {
        return word_pictures.bytes() + table.planned_gpu_bytes();
    }

private:
    bool words_released_ = false;
};

/// `frames`: the set's reader begins at once; none: call ArtifactCache::start later.
[[nodiscard]] Result<std::unique_ptr<ShownSet>> open_set(const settings::Settings& settings,
                                                         const SetOptions& options, const SetRequest& request,
                                                         const std::optional<ExpectedFrames>& frames);

} // namespace frustumscreen::show
