/// The artifact cache: artifacts in memory, with their texts, loaded ahead of the visitor, in pieces, within
/// a budget.
///
///     request -> next_step (residency.h) -> ArtifactReader -> prepared -> some bytes a frame (loaded.h) ->
///     ready
///
/// Texts    The chosen artifact's caption comes before the artifact, because it is smaller; its narration
///          comes after it, only in the chosen language. Artifacts that may be chosen next bring their
///          captions; the chosen one's captions in the other languages come last. Texts stay while they are
///          shown and while the budget allows, and no longer than their artifact.
/// Pages    of the shown site (RunCells) are loaded after everything needed, while the budget allows; a page stays as
///          long as the picture or a window shows it.
/// Budget   counts an artifact's GPU memory and main memory from the moment that it is prepared. While one is
///          read, its file's parts and one level of it are needed in addition.
/// Threads  constructed on any thread; everything else on the render thread, with the display's context
///          current, including destruction unless everything was released. The reader has a thread of its
///          own, which exists only if there is more to load. A step reads no file and waits for nothing.
/// Errors   an artifact that proves unusable is left out, with a line on standard error; the others stay. If
///          only its texts are unusable, only they are left out.
#pragma once

#include "app/exhibit/artifact_state.h"
#include "app/library/unshown_pack.h"
#include "app/pack/container/limits.h"
#include "app/render/gpu_store.h"
#include "app/residency/artifact_reader.h"
#include "app/residency/loaded.h"
#include "app/residency/prepared_artifact.h"
#include "app/residency/residency.h"
#include "app/settings/settings.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace frustumscreen::residency {

struct ArtifactCacheSetUp {
    std::vector<KnownArtifact> artifacts; ///< at least one
    std::string technique = "auto";
    double deadline_ms = 16.0;
    std::uint64_t budget_bytes = 0;
    TextStyle style = {};
    std::string language = "en"; ///< of the first caption, BCP 47
    bool waits = false; ///< `step` returns once loading is complete, so that a run of simulated time is
                        ///< repeatable
    std::string_view program = "frustumscreen";      ///< prefix of its lines on standard error
    std::vector<library::UnshownPack> left_out = {}; ///< left out before
};

/// The cache request: the shown artifact, and those that may be shown next.
struct CacheRequest {
    std::size_t shown = 0;
    std::string_view shown_language;     ///< of the shown artifact's texts, BCP 47
    std::span<const std::size_t> wanted; ///< most urgent first, beginning with the chosen one; as
                                         ///< WantedArtifacts
    std::string_view language;           ///< the chosen language
};

class ArtifactCache {
public:
    /// Bytes uploaded per frame for an artifact that the visitor waits for, and for one loaded ahead.
    static constexpr std::uint64_t urgent_bytes = std::uint64_t{4} << 20U;
    static constexpr std::uint64_t early_bytes = std::uint64_t{1} << 20U;

    /// `first`: the first artifact, not yet uploaded. Needs no context.
    ArtifactCache(ArtifactCacheSetUp set_up, PreparedArtifact first);
    /// Waits for the reader, if there is one. Does not empty the store: release everything first.
    ~ArtifactCache();
    ArtifactCache(const ArtifactCache&) = delete;
    ArtifactCache& operator=(const ArtifactCache&) = delete;

    /// Uploads the first artifact and its caption at once. On failure nothing stays in the store.
    [[nodiscard]] Result<void> upload_first(render::GpuStore& store);
    /// Starts loading the other artifacts; needs no context. `cost`: of frames on this GPU; `prop`, `view`,
    /// `eye_m`: the pose and eye for the expected times of quality levels.
    void start(const scene::FrameCost& cost, const geometry::PropShape& prop, const scene::PlanView& view,
               const glm::dvec3& eye_m);
    /// Call once a frame.
    void step(render::GpuStore& store, const CacheRequest& request);
    /// True if everything shown and waited for is in memory, except for items that were left out.
    [[nodiscard]] bool has(const CacheRequest& request) const;
    /// Releases one more artifact or text from the store and stops requesting; false: nothing was left.
    bool release_some(render::GpuStore& store);

    /// Null if the artifact is not ready.
    [[nodiscard]] RunLevels* find(std::size_t artifact);
    [[nodiscard]] const RunLevels* find(std::size_t artifact) const;
    /// Null if the artifact is not ready, or nothing of it moves.
    [[nodiscard]] RunCells* find_cells(std::size_t artifact) const;
    [[nodiscard]] double exposure(std::size_t artifact) const;
    /// None if the artifact is not ready, or has no hotspots.
    [[nodiscard]] exhibit::ArtifactTriangles triangles(std::size_t artifact) const;
    /// Null if none of the part is loaded.
    [[nodiscard]] const LoadedTexts* texts(std::size_t artifact, TextPart part, std::size_t language) const;
    [[nodiscard]] const KnownArtifact& known(std::size_t artifact) const {
        return set_up_.artifacts[artifact];
    }
    [[nodiscard]] std::size_t size() const { return set_up_.artifacts.size(); }
    [[nodiscard]] std::span<const exhibit::ArtifactState> states() const { return states_; }
    /// Includes those of the set-up. A list is immutable, so that another thread can report it; a change
    /// makes a new list.
    [[nodiscard]] const library::UnshownPacks& left_out() const { return left_out_; }

    [[nodiscard]] std::size_t ready() const;                 ///< artifacts that can be drawn at once
    [[nodiscard]] std::uint64_t bytes() const;               ///< of everything loaded or being uploaded
    [[nodiscard]] std::uint64_t uploaded_text_bytes() const; ///< of texts in the store
    [[nodiscard]] std::uint64_t switches() const;            ///< of quality levels, including those of
                                                             ///< released artifacts
    [[nodiscard]] std::uint64_t ignored_times() const;

private:
    using Loaded = std::variant<LoadedLevels, LoadedTexts, LoadedPage>;
    /// A unit that is loaded and released as a whole.
    struct Item {
        std::size_t artifact = 0;
        std::optional<TextPart> part; ///< nullopt: the levels, or a page
        std::size_t language = 0;     ///< of the part
        std::optional<PageName> page = std::nullopt;

        [[nodiscard]] bool is_levels() const { return !part && !page; }
    };
    /// Items in order of urgency.
    class Queue {
    public:
        void add(std::size_t item) { items_.at(count_++) = item; }
        [[nodiscard]] std::span<const std::size_t> items() const { return std::span(items_).first(count_); }

    private:
        /// Beside them the shown and the wanted artifacts with their texts (exhibit::WantedArtifacts).
        std::array<std::size_t,
                   8 + 2 * (settings::max_windows + 1) + pack::max_languages + 2 * RunCells::max_wanted_pages>
            items_{};
        std::size_t count_ = 0;
    };

    [[nodiscard]] std::size_t levels_item(std::size_t artifact) const { return first_items_[artifact]; }
    [[nodiscard]] std::size_t text_item(std::size_t artifact, TextPart part, std::size_t language) const;
    /// Adds nothing if the artifact has no such text.
    void add_text(Queue& queue, std::size_t artifact, TextPart part, std::string_view language) const;
    /// The pages that the shown artifact wants.
    void add_pages(Queue& queue, std::size_t artifact) const;
    [[nodiscard]] Queue needed(const CacheRequest& request) const;
    [[nodiscard]] Queue wanted(const CacheRequest& request) const;
    [[nodiscard]] Result<ArtifactReader::Prepared> prepare(std::size_t item,
                                                           const ArtifactReader::GivenUp& given_up) const;

    void step_once(render::GpuStore& store, const CacheRequest& request);
    void note_shown(const CacheRequest& request);
    void receive(std::size_t item, Result<ArtifactReader::Prepared> prepared);
    /// Call once the levels are prepared, when the sizes of their textures are known.
    void expect_pages(std::size_t artifact, const PreparedArtifact& levels);
    [[nodiscard]] bool arrives(std::size_t item) const;
    void upload(render::GpuStore& store, std::span<const std::size_t> needed,
                std::span<const std::size_t> wanted);
    [[nodiscard]] Result<void> upload(render::GpuStore& store, std::size_t item, std::uint64_t max_bytes);
    void release(render::GpuStore& store, std::size_t item);
    /// False: it is a page that is still shown.
    bool release_if_unseen(render::GpuStore& store, std::size_t item);
    void leave_out(std::size_t item, const std::string& reason);
    void say_left_out(std::size_t item, const std::string& reason) const;
    /// Null if they are not loaded.
    [[nodiscard]] LoadedLevels* levels(std::size_t artifact) const;

    ArtifactCacheSetUp set_up_;
    std::vector<Item> items_;
    std::vector<std::size_t> first_items_; ///< by artifact: its levels; its texts follow, then its pages
    std::vector<std::size_t> first_pages_; ///< by artifact
    std::vector<std::unique_ptr<Loaded>> loaded_; ///< by item; null: not loaded
    std::vector<ResidentItem> records_;           ///< by item
    std::vector<exhibit::ArtifactState> states_;
    library::UnshownPacks left_out_;
    std::optional<std::size_t> shown_;
    std::uint64_t shows_ = 0; ///< number of changes of the shown artifact
    bool steady_ = false;     ///< the latest step left nothing to do
    std::uint64_t past_switches_ = 0, past_ignored_times_ = 0;
    std::unique_ptr<ArtifactReader> reader_; ///< last: its thread uses `set_up_`
};

} // namespace frustumscreen::residency
