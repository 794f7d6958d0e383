/// The artifacts that are in memory, with their texts: loaded ahead of the visitor, in pieces, within a budget.
///
///     wish -> next_step (residency.h) -> ArtifactReader -> prepared -> some bytes a frame (loaded.h) -> ready
///
/// Texts    The chosen artifact's caption comes before the artifact, as it is smaller; what is told of it comes after it, in the
///          chosen language alone. What may be chosen next brings its caption; last come the chosen one's captions in the other
///          languages. Texts stay while they are shown and while there is room, and no longer than their artifact.
/// Budget   counts what an artifact takes of the GPU's memory and of main memory from the moment that it is prepared.
///          While one is read, its file's parts and one level of it come on top.
/// Threads  made on any; the render thread, with the display's context current, for all else, and to destroy what is not all
///          released; the reader is a thread of
///          its own, there only where there is more to come. A step reads no file and waits for nothing.
/// Errors   an artifact that turns out bad is left out, with a line on standard error; the others stay. Texts that turn out
///          bad are left out alone.
#pragma once

#include "app/exhibit/artifact_state.h"
#include "app/library/pack_left_out.h"
#include "app/pack/container/limits.h"
#include "app/render/gpu_store.h"
#include "app/residency/artifact_reader.h"
#include "app/residency/loaded.h"
#include "app/residency/prepared_artifact.h"
#include "app/residency/residency.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace frustumscreen {

struct ResidentsSetUp {
    std::vector<KnownArtifact> artifacts; ///< at least one
    std::string technique = "auto";
    double deadline_ms = 16.0;
    std::uint64_t budget_bytes = 0;
    TextStyle style = {};
    std::string language = "en"; ///< of the first caption, BCP 47
    bool waits = false; ///< a step ends when all is there, so that a run of simulated time is repeatable
    std::string_view program = "frustumscreen"; ///< whose lines on standard error they are
    std::vector<PackLeftOut> left_out = {};     ///< before
};

/// What is shown, and what may be shown next.
struct ResidentsWish {
    std::size_t shown = 0;
    std::string_view shown_language;     ///< BCP 47; of its texts
    std::span<const std::size_t> wanted; ///< most urgent first: the chosen one; as WantedArtifacts
    std::string_view language;           ///< the chosen one
};

class Residents {
public:
    /// Bytes that one frame uploads of what the visitor waits for, and of what is loaded ahead.
    static constexpr std::uint64_t urgent_bytes = std::uint64_t{4} << 20U;
    static constexpr std::uint64_t early_bytes = std::uint64_t{1} << 20U;

    /// `first`: of the first artifact; nothing is in the store yet. Needs no context.
    Residents(ResidentsSetUp set_up, PreparedArtifact first);
    /// Waits for the reader, if there is one. What is in the store stays there: release it first.
    ~Residents();
    Residents(const Residents&) = delete;
    Residents& operator=(const Residents&) = delete;

    /// Uploads the first artifact at once, and its caption with it. On failure nothing stays in the store.
    [[nodiscard]] Result<void> upload_first(GpuStore& store);
    /// From now on the others may come; needs no context. `cost`: of frames on this GPU; `prop`, `view`: what a rung's time is expected for,
    /// `eye_m` its eye.
    void start(const FrameCost& cost, const PropShape& prop, const PlanView& view, const glm::dvec3& eye_m);
    /// Once a frame.
    void step(GpuStore& store, const ResidentsWish& wish);
    /// All that is shown, and what somebody waits for, is there as far as it can be.
    [[nodiscard]] bool has(const ResidentsWish& wish) const;
    /// Takes some more out of the store, and asks for nothing any more; false: nothing was left.
    bool release_some(GpuStore& store);

    /// Null if it is not ready.
    [[nodiscard]] RunLevels* find(std::size_t artifact);
    [[nodiscard]] const RunLevels* find(std::size_t artifact) const;
    [[nodiscard]] double exposure(std::size_t artifact) const;
    /// None if it is not ready, or has no hotspots.
    [[nodiscard]] ArtifactTriangles triangles(std::size_t artifact) const;
    /// Null if none of it is there.
    [[nodiscard]] const LoadedTexts* texts(std::size_t artifact, TextPart part, std::size_t language) const;
    [[nodiscard]] const KnownArtifact& known(std::size_t artifact) const {
        return set_up_.artifacts[artifact];
    }
    [[nodiscard]] std::size_t size() const { return set_up_.artifacts.size(); }
    [[nodiscard]] std::span<const ArtifactState> states() const { return states_; }
    /// With those of before. A list never changes, for who reports it on another thread; there is another one instead.
    [[nodiscard]] const PacksLeftOut& left_out() const { return left_out_; }

    [[nodiscard]] std::size_t ready() const;                 ///< how many artifacts can be drawn at once
    [[nodiscard]] std::uint64_t bytes() const;               ///< of all that is loaded or being uploaded
    [[nodiscard]] std::uint64_t uploaded_text_bytes() const; ///< of texts in the store
    [[nodiscard]] std::uint64_t switches() const;            ///< of levels, of artifacts here or gone
    [[nodiscard]] std::uint64_t ignored_times() const;

private:
    using Loaded = std::variant<LoadedLevels, LoadedTexts>;
    /// What comes and goes as one.
    struct Item {
        std::size_t artifact = 0;
        std::optional<TextPart> part; ///< none: the levels
        std::size_t language = 0;     ///< of the part
    };
    /// Items in order of urgency.
    class Queue {
    public:
        void add(std::size_t item) { items_.at(count_++) = item; }
        [[nodiscard]] std::span<const std::size_t> items() const { return std::span(items_).first(count_); }

    private:
        std::array<std::size_t, 8 + pack_format::most_languages> items_{};
        std::size_t count_ = 0;
    };

    [[nodiscard]] std::size_t levels_item(std::size_t artifact) const { return first_items_[artifact]; }
    [[nodiscard]] std::size_t text_item(std::size_t artifact, TextPart part, std::size_t language) const;
    /// Nothing where the artifact has no such text.
    void add_text(Queue& queue, std::size_t artifact, TextPart part, std::string_view language) const;
    [[nodiscard]] Queue needed(const ResidentsWish& wish) const;
    [[nodiscard]] Queue wanted(const ResidentsWish& wish) const;
    [[nodiscard]] Result<ArtifactReader::Prepared> prepare(std::size_t item,
                                                           const ArtifactReader::GivenUp& given_up) const;

    void step_once(GpuStore& store, const ResidentsWish& wish);
    void note_shown(const ResidentsWish& wish);
    void receive(std::size_t item, Result<ArtifactReader::Prepared> prepared);
    [[nodiscard]] bool arrives(std::size_t item) const;
    void upload(GpuStore& store, std::span<const std::size_t> needed, std::span<const std::size_t> wanted);
    [[nodiscard]] Result<void> upload(GpuStore& store, std::size_t item, std::uint64_t most_bytes);
    void release(GpuStore& store, std::size_t item);
    void leave_out(std::size_t item, const std::string& reason);
    void say_left_out(std::size_t item, const std::string& reason) const;
    /// Null if they are not loaded.
    [[nodiscard]] LoadedLevels* levels(std::size_t artifact) const;

    ResidentsSetUp set_up_;
    std::vector<Item> items_;
    std::vector<std::size_t> first_items_;        ///< by artifact: its levels; its texts are the next ones
    std::vector<std::unique_ptr<Loaded>> loaded_; ///< by item; none: it is not there
    std::vector<ResidentItem> records_;           ///< by item
    std::vector<ArtifactState> states_;
    PacksLeftOut left_out_;
    std::optional<std::size_t> shown_;
    std::uint64_t shows_ = 0; ///< how often another one was shown
    bool steady_ = false;     ///< nothing was left to do at the latest step
    std::uint64_t past_switches_ = 0, past_ignored_times_ = 0;
    std::unique_ptr<ArtifactReader> reader_; ///< last: its thread uses `set_up_`
};

} // namespace frustumscreen
