/// What is told of a stick, beside what visitors are shown: decided in each step, drawn from textures of its own.
///
///     ImportWatch -> StickNotice, NoticePlace -> Presentation::notice -> NoticeTextures -> OnTable
///
/// It outlives the artifacts: a set that is taken in meanwhile changes nothing of it.
///
/// Language the house's; its words and its speech are those of the file of words.
/// Threads  the render thread. `step` allocates nothing while nothing new is said of a stick.
/// Errors   where the settings name no words, nothing is read. Words that cannot be read are a line on standard error; then the
///          journal and the status alone have it.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/exhibit/stick_notice.h"
#include "app/render/gpu_store.h"
#include "app/residency/on_table.h"
#include "app/residency/prompt_reader.h"
#include "app/settings/settings.h"
#include "app/show/import_watch.h"
#include "app/typography/visitor_side.h"
#include "firmware_host/base/result.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen {

class NoticeShow {
public:
    static constexpr double found_gain_db = -9.0; ///< nobody asked for it

    /// Reads the words. `answer`: of a clock that is not the wall's, always.
    NoticeShow(const Settings& settings, ImportWatch::Answer answer);

    /// Whether a press ends what is shown; then it does nothing else.
    [[nodiscard]] bool take_press(MonotonicTime now, std::span<const Command> commands);
    /// Adds the notice to what the exhibit shows at this step.
    void step(MonotonicTime now, const TrackedState& tracked_state, Presentation& presentation);
    /// What is to be said now, if nothing else is; none: nothing. It stays until it was.
    [[nodiscard]] const SharedRecording& announcement() const { return announcement_; }
    void announced() { said_ = due_; }

    [[nodiscard]] bool speaks() const { return found_ || take_out_; }
    /// None: nothing was said of any stick.
    [[nodiscard]] const SharedImport& import() const { return import_; }

private:
    [[nodiscard]] SharedNotice wanted(const std::optional<ShownNotice>& shown) const;
    void place(MonotonicTime now, const SharedNotice& wanted, const TrackedState& tracked_state,
               Presentation& presentation);

    PropShape prop_;
    glm::dvec3 lens_m_;
    SharedRecording found_, take_out_; ///< spoken
    StickNotice notice_;
    NoticePlace place_;
    VisitorSide side_;
    SharedImport import_;
    /// A word that is said once for each import.
    struct Said {
        std::uint64_t import = 0;
        std::string_view key;
        [[nodiscard]] bool operator==(const Said&) const = default;
    };
    std::optional<Said> said_; ///< last
    std::optional<Said> due_;
    SharedRecording announcement_;
    bool lies_there_ = false;          ///< at the step before: a press is for it
    std::optional<ImportWatch> watch_; ///< none: no stick is told of
};

/// A notice's picture in the GPU's memory, in the shape that is shown, while it is.
class NoticeTextures {
public:
    /// Before the first frame.
    [[nodiscard]] Result<void> prepare(GpuStore& store);
    /// Drawn once, they make the driver compile what notices need: it may tell textures by their sizes.
    [[nodiscard]] std::array<TextureId, 2> samples() const { return {white_, sample_}; }
    /// Uploads what is new, and lets go of what is not shown. `brightness`: of texts, share of the projector's light.
    void place(const std::optional<PresentedNotice>& notice, double brightness, const Pinhole& projector,
               const RigidTransform& table_from_projector, std::span<const glm::dvec2> room, GpuStore& store,
               OnTable& on_table);
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const;

private:
    void follow(const SharedNotice& picture, std::size_t shape, GpuStore& store);

    SharedNotice picture_;
    std::size_t shape_ = 0;
    TextureId texture_ = TextureId::None; ///< none: the driver has no memory
    TextureId white_ = TextureId::None;   ///< one texel: what the ring is drawn with
    TextureId sample_ = TextureId::None;  ///< of a size like words': with mip levels, and no power of two
};

} // namespace frustumscreen
