/// The packs of the room behind the screen in memory: at the start only their manifests, then each quality level that the
/// picture wants, within a budget of memory.
///
/// Order    by urgency, as the picture says in each frame. A model that nothing wants is unloaded first, then one less urgent than
///          what needs its memory; never what the picture shows.
/// Frame    some megabytes are uploaded, one quality level at a time; nothing is read. Without a thread of its own (offline)
///          everything that is wanted and fits is read and uploaded at once.
///
/// Units    bytes of main and GPU memory.
/// Threads  the render thread, with the display's context current, including destruction; one thread of its own reads packs.
/// Errors   a pack that cannot be read is missing; one sentence, once, says why (`faults`).
#pragma once

#include "app/render/gpu_store.h"
#include "app/residency/background_reader.h"
#include "app/residency/known_model.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace frustumscreen::residency {

struct RoomModelsOptions {
    std::uint64_t max_bytes = 96'000'000;
    std::uint64_t max_upload_bytes = 4'000'000; ///< in a frame
    bool waits = true;                          ///< reads at once, without a thread
};

class RoomModels {
public:
    using Options = RoomModelsOptions;

    /// `models`: nothing for a pack that could not be opened. `store` must outlive this.
    RoomModels(std::vector<std::optional<KnownModel>> models, const Options& options,
               render::GpuStore& store);
    RoomModels(const RoomModels&) = delete;
    RoomModels& operator=(const RoomModels&) = delete;

    /// Null if the pack is missing.
    [[nodiscard]] const KnownModel* find(std::size_t model) const {
        return entries_[model].is_missing ? nullptr : &*entries_[model].known;
    }
    /// Null unless the quality level is in memory.
    [[nodiscard]] const scene::PlacedLevel* find(std::size_t model, std::size_t quality_level) const;
    /// The box inside the model's solid; nothing if there is none, or if it is not known yet.
    [[nodiscard]] const std::optional<scene::BoxCorners>& solid(std::size_t model) const {
        return entries_[model].solid;
    }

    /// Call before the `want` calls of a frame.
    void begin_frame();
    /// `urgency`: larger is more urgent, above 0.
    void want(std::size_t model, std::size_t quality_level, double urgency);
    void want_solid(std::size_t model, double urgency);
    /// Call for what the picture shows: it stays in memory.
    void keep(std::size_t model, std::size_t quality_level);
    /// Call after these: reads, uploads and unloads.
    void go_on();

    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    /// True while something is wanted that is not in memory and can be.
    [[nodiscard]] bool is_loading() const { return reading_.has_value() || upload_.has_value(); }
    /// The models read, in order; for tests and reports.
    [[nodiscard]] std::span<const std::string> loaded() const { return loaded_; }
    [[nodiscard]] std::span<const std::string> faults() const { return faults_; }

private:
    using Item = std::variant<ReadQualityLevel, std::optional<scene::BoxCorners>>;
    /// The memory of a quality level.
    struct Slot {
        scene::PlacedLevel placed;
        bool is_there = false;
        bool is_shown = false;
        double urgency = 0.0; ///< 0: not wanted
    };
    struct Entry {
        std::optional<KnownModel> known;
        bool is_missing = false;
        std::vector<Slot> slots; ///< by quality level
        std::optional<scene::BoxCorners> solid;
        bool is_solid_known = false;
        double solid_urgency = 0.0;
    };
    /// A quality level of a model; if `quality_level` equals their number, the model's solid.
    struct Place {
        std::size_t model = 0, quality_level = 0;
        [[nodiscard]] bool operator==(const Place&) const = default;
    };
    struct Upload {
        Place place;
        render::LevelUpload upload;
        std::shared_ptr<const scene::LevelTriangles> triangles;
        std::shared_ptr<const relief::BlockRelief> relief;
    };
    [[nodiscard]] Result<Item> read(const Place& place) const;
    [[nodiscard]] std::optional<Place> next_to_read() const;
    /// Unloads less urgent quality levels until the bytes fit; false if they cannot.
    [[nodiscard]] bool make_space(std::uint64_t bytes, double urgency);
    void unload(const Place& place);
    void receive(const Place& place, Result<Item> item);
    void go_on_uploading(std::uint64_t max_bytes);
    void give_up(const Place& place, const Error& error);
    [[nodiscard]] std::size_t number_of(const Place& place) const;
    [[nodiscard]] Place place_of(std::size_t number) const;

    Options options_;
    render::GpuStore& store_;
    std::vector<Entry> entries_;
    std::vector<std::size_t> first_; ///< number of each model's first item
    std::uint64_t bytes_ = 0;        ///< of what is there, and on its way
    std::optional<Place> reading_;
    std::optional<Upload> upload_;
    std::vector<std::string> loaded_, faults_;
    std::unique_ptr<BackgroundReader<Item>> reader_; ///< last: its thread uses `entries_`' files
};

} // namespace frustumscreen::residency
