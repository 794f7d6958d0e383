/// Keeps in memory all that torches throw onto the artifact on show: pictures, films and layers of its pack; and the layers of its
/// states. Only an exhibit with torches, or with windows that show such states, has one.
///
///     step, once a frame: what the lights throw -> BackgroundReader -> one upload a frame -> shown
///
/// Pictures  are taken at the finest mip whose upload fits into a frame.
/// Films     stay packed in memory; a thread decodes the next frame ahead, and each is uploaded when it is due. A processor
///           that is too slow leaves frames out.
/// Layers    are handed on (`take_layer`) once, to become textures of the artifact's drawables.
/// Memory    at most `max_bytes`; what exceeds it is left out, with a line on standard error.
/// Threads   the render thread, with the display's context current, including destruction unless everything was released.
///           One thread of its own reads and decodes.
/// Errors    a part that cannot be read is left out, with a line on standard error.
#pragma once

#include "app/pack/pack_torches.h"
#include "app/render/gpu_store.h"
#include "app/residency/background_reader.h"
#include "app/residency/prepared_artifact.h"
#include "app/residency/read_layer.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace frustumscreen::residency {

/// An artifact's contents, as its manifest has them.
struct ThrownContents {
    std::filesystem::path file;
    pack::PackTorches torches;
    std::vector<std::size_t> texture_of_level{};
    std::vector<std::size_t> relief_corners{};  ///< by relief of the pack
    std::vector<std::uint32_t> relief_texels{}; ///< the same
    std::shared_ptr<const KnownWorld> world{};  ///< null: nothing of it moves
};

/// The contents of each artifact, from its manifest.
[[nodiscard]] Result<std::vector<ThrownContents>> thrown_contents(std::span<const KnownArtifact> artifacts);

/// A content that a light throws now.
struct WantedContent {
    std::size_t content = 0;
    double seconds = 0.0; ///< since it began
};

class TorchContents {
public:
    static constexpr std::uint64_t max_upload_bytes = std::uint64_t{4} << 20U; ///< in a frame, without mips

    struct Options {
        std::uint64_t max_bytes = 48'000'000;
        bool waits = false; ///< `step` returns once all that is wanted is there; then there is no thread
        std::string_view program = "frustumscreen"; ///< prefix of its lines on standard error
    };
    TorchContents(std::vector<ThrownContents> artifacts, const Options& options);
    ~TorchContents();
    TorchContents(const TorchContents&) = delete;
    TorchContents& operator=(const TorchContents&) = delete;

    /// Call once a frame. `artifact`: on show; contents of another one are released. `layers`: wanted for themselves.
    void step(render::GpuStore& store, std::size_t artifact, std::span<const WantedContent> wanted,
              std::span<const std::size_t> layers = {});
    /// Returns a layer that has been read, once; none: there is no new one.
    [[nodiscard]] std::optional<ReadLayer> take_layer();
    /// Reports that the layer is in the store, or why it is not.
    void note_layer(std::size_t layer, const Result<void>& uploaded);
    void release(render::GpuStore& store);

    /// The artifact whose contents are held; nullopt: none.
    [[nodiscard]] const std::optional<std::size_t>& artifact() const { return artifact_; }
    [[nodiscard]] const torch::Content* find(std::size_t artifact, std::size_t content) const;
    /// A content of the artifact on show.
    struct Shown {
        bool ready = false; ///< false: it cannot be thrown yet
        scene::TextureId picture = scene::TextureId::None;
        std::uint32_t version = 0; ///< of the picture
    };
    [[nodiscard]] Shown shown(std::size_t content) const;
    /// Bytes of main memory and GPU memory.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    struct ReadPicture {
        std::vector<image::Image8> mips;
    };
    struct ReadFilm {
        std::vector<image::Image8> first; ///< with its mips, for which the texture has space
        std::uint64_t packed_bytes = 0;
    };
    struct ReadFrame {
        image::Image8 picture;
    };
    using Read = std::variant<ReadPicture, ReadFilm, ReadFrame, ReadLayer>;
    using Reader = BackgroundReader<Read>;
    enum class Kind : std::uint8_t { Picture, Film, Layer, Frame };
    struct Part {
        Kind kind = Kind::Picture;
        std::size_t number = 0; ///< of the pictures, films or layers
        std::size_t frame = 0;
    };
    enum class PartState : std::uint8_t { Absent, Read, Ready, LeftOut };
    struct Film {
        scene::TextureId texture = scene::TextureId::None;
        std::size_t shown = 0, due = 0;
        std::uint32_t version = 0;
        bool runs = false; ///< a light throws it
        std::optional<std::size_t> ahead_frame;
        image::Image8 ahead;
    };

    [[nodiscard]] static std::size_t item_of(std::size_t artifact, const Part& part);
    [[nodiscard]] static std::pair<std::size_t, Part> part_of(std::size_t item);
    /// Called on the reader's thread.
    [[nodiscard]] Result<Read> read(std::size_t item);
    void receive(render::GpuStore& store, std::size_t item, Result<Read> read);
    [[nodiscard]] Result<void> upload(render::GpuStore& store, const Part& part, Read read);
    void run_films(render::GpuStore& store, std::span<const WantedContent> wanted);
    /// The next part to read.
    [[nodiscard]] std::optional<Part> next(std::span<const WantedContent> wanted,
                                           std::span<const std::size_t> layers) const;
    [[nodiscard]] std::optional<Part> next_of(const torch::Content& content) const;
    [[nodiscard]] PartState state(const Part& part) const;
    void leave_out(const Part& part, std::string_view why);

    std::vector<ThrownContents> artifacts_;
    Options options_;
    std::optional<std::size_t> artifact_; ///< whose contents are here
    std::vector<PartState> picture_states_, film_states_, layer_states_;
    std::vector<scene::TextureId> pictures_;
    std::vector<Film> films_;
    std::optional<ReadLayer> layer_;
    std::uint64_t bytes_ = 0;

    /// The reader's thread alone: the packed films of one artifact.
    std::optional<std::size_t> packed_of_;
    std::map<std::size_t, std::vector<Bytes>> packed_;
    std::unique_ptr<Reader> reader_; ///< last: its thread uses the others; none with `waits`
};

} // namespace frustumscreen::residency
