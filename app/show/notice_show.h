/// The notice about a stick beside what visitors are shown: decided in each step, drawn from its own textures.
///
///     ImportWatch -> StickNotice, NoticePlace -> Presentation::notice -> NoticeTextures -> OnTable
///
/// It is independent of the set: a change of the set does not affect it.
///
/// Language the house's; texts and speech are those of the file of words.
/// Threads  the render thread. `step` allocates nothing while the report does not change.
/// Errors   if the settings name no file of words, nothing is read. An unreadable file gives a line on standard
///          error; then only the journal and the status report the import.
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

namespace frustumscreen::show {

class NoticeShow {
public:
    static constexpr double found_gain_db = -9.0; ///< quieter, because it comes unasked

    /// Reads the texts. `answer`: Always on a simulated clock.
    NoticeShow(const settings::Settings& settings, ImportWatch::Answer answer);

    /// True if a press ends the notice; then the press has no other effect.
    [[nodiscard]] bool take_press(MonotonicTime now, std::span<const settings::Command> commands);
    /// Adds the notice to the presentation of this step.
    void step(MonotonicTime now, const tracking::TrackedState& tracked_state,
              exhibit::Presentation& presentation);
    /// The recording to play when nothing else is heard; null: none. It stays until `announced`.
    [[nodiscard]] const residency::SharedRecording& announcement() const { return announcement_; }
    void announced() { said_ = due_; }

    [[nodiscard]] bool speaks() const { return found_ || take_out_; }
    /// Null: there was no report of any stick.
    [[nodiscard]] const SharedImport& import() const { return import_; }

private:
    [[nodiscard]] exhibit::SharedNotice wanted(const std::optional<exhibit::ShownNotice>& shown) const;
    void place(MonotonicTime now, const exhibit::SharedNotice& wanted,
               const tracking::TrackedState& tracked_state, exhibit::Presentation& presentation);

    geometry::PropShape prop_;
    glm::dvec3 lens_m_;
    residency::SharedRecording found_, take_out_; ///< spoken
    exhibit::StickNotice notice_;
    exhibit::NoticePlace place_;
    typography::VisitorSide side_;
    SharedImport import_;
    /// A text that is spoken once for each import.
    struct Said {
        std::uint64_t import = 0;
        std::string_view key;
        [[nodiscard]] bool operator==(const Said&) const = default;
    };
    std::optional<Said> said_; ///< the last one
    std::optional<Said> due_;
    residency::SharedRecording announcement_;
    bool lies_there_ = false;          ///< in the previous step; a press then ends the notice
    std::optional<ImportWatch> watch_; ///< none: notices are off
};

/// The shown notice's picture in the GPU's memory, in the shown shape.
class NoticeTextures {
public:
    /// Call before the first frame.
    [[nodiscard]] Result<void> prepare(render::GpuStore& store);
    /// Textures to draw once before the first frame, so that the driver compiles for notices: it may distinguish
    /// textures by size.
    [[nodiscard]] std::array<scene::TextureId, 2> samples() const { return {white_, sample_}; }
    /// Uploads a new picture and releases one that is not shown. `brightness`: of texts, fraction of the projector's
    /// light.
    void place(const std::optional<exhibit::PresentedNotice>& notice, double brightness,
               const geometry::Pinhole& projector, const geometry::RigidTransform& table_from_projector,
               std::span<const glm::dvec2> area, render::GpuStore& store, residency::OnTable& on_table);
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const;

private:
    void follow(const exhibit::SharedNotice& picture, std::size_t shape, render::GpuStore& store);

    exhibit::SharedNotice picture_;
    std::size_t shape_ = 0;
    scene::TextureId texture_ = scene::TextureId::None; ///< None: the driver has no memory for it
    scene::TextureId white_ = scene::TextureId::None;   ///< one texel, for drawing the ring
    scene::TextureId sample_ =
        scene::TextureId::None; ///< of a size like a text's: with mip levels, and no power of two
};

} // namespace frustumscreen::show
