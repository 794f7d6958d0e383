/// The exhibit for visitors: what `Exhibit` decides, drawn by a PresentationShow. For the staff it shows the staff
/// picture (staff_show.h).
///
/// Memory   the staff picture is created on request and freed afterwards: it costs nothing the rest of the time.
/// Threads  the render thread, with the display's context current.
/// Errors   a typeface is missing: the exhibit goes on, and a line on standard error says so.
#pragma once

#include "app/exhibit/copy_offer.h"
#include "app/exhibit/exhibit.h"
#include "app/exhibit/reset_offer.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"
#include "app/show/notice_show.h"
#include "app/show/room_taking.h"
#include "app/show/set_switch.h"
#include "app/show/show.h"
#include "app/show/speaker.h"
#include "app/show/staff_show.h"
#include "firmware_host/sound/volume.h"

#include <memory>
#include <optional>
#include <string>

namespace frustumscreen::show {

[[nodiscard]] sound::Volume volume_of(const settings::SoundSettings& settings);

class LiveExhibit final : public Show {
public:
    /// `driver`: the display's name for itself.
    /// `answer`: Always on a simulated clock.
    LiveExhibit(const settings::Settings& settings, std::unique_ptr<PresentationShow> show,
                exhibit::Exhibit exhibit, std::string driver,
                residency::PromptReader::Answer answer = residency::PromptReader::Answer::WhenReady);

    /// Accepts other sets from here on; `artifacts` is the PresentationShow.
    void watch(ArtifactShow& artifacts, std::unique_ptr<LibraryWatch> library);

    /// From here on artifacts are taken out of the room behind the screen, and put back.
    void set_room(std::unique_ptr<RoomTaking> room);
    /// The room's objects that are not in their places, as of the latest step; for RoomShow::draw of the same time.
    [[nodiscard]] std::span<const room::TakenPose> taken() const override {
        return room_ ? room_->poses() : std::span<const room::TakenPose>();
    }

    void step(MonotonicTime now, std::span<const settings::Command> commands,
              const tracking::TrackedState& on_table) override;
    void tell(const RunStatus& status) override;
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const tracking::TrackedState& on_table,
                                          const render::RenderTarget& target, render::Redraw redraw) override;
    void record_time(MonotonicTime now, double ms) override;
    [[nodiscard]] ShowState state() const override;
    [[nodiscard]] const sound::SoundRequest& sound_request() const override { return speaker_.request(); }
    [[nodiscard]] bool speaks() const override { return presentation_show_->speaks() || notice_.speaks(); }
    void hear(const sound::SoundReport& report) override;
    [[nodiscard]] bool sleeps() const override { return true; }
    void set_light(double light) override { light_ = light; }
    void set_mark(const std::optional<drift::ShownMark>& mark) override { mark_ = mark; }
    void set_viewfinder(Viewfinder* viewfinder) override { viewfinder_ = viewfinder; }
    void set_signal(const tracking::TrackerSignal& prop, const tracking::TrackerSignal& head) override {
        prop_signal_ = prop;
        head_signal_ = head;
    }

private:
    /// The commands that a notice leaves to the exhibit.
    [[nodiscard]] std::span<const settings::Command>
    left_by_notice(MonotonicTime now, std::span<const settings::Command> commands);
    void follow_staff_mode();
    void follow_copy(MonotonicTime now);
    [[nodiscard]] render::DrawResult draw_presentation(MonotonicTime now,
                                                       const tracking::TrackedState& on_table,
                                                       const render::RenderTarget& target,
                                                       render::Redraw redraw);

    const settings::Settings& settings_;
    scene::StereoLayout layout_;
    std::unique_ptr<PresentationShow> presentation_show_;
    std::string driver_;
    std::unique_ptr<SetSwitch> set_switch_; ///< none: the set never changes
    std::unique_ptr<RoomTaking> room_;      ///< none: no screen behind the table
    exhibit::Exhibit exhibit_;
    exhibit::Presentation presentation_; ///< of the latest step
    Speaker speaker_;
    NoticeShow notice_;
    SharedImport import_; ///< of the previous step
    exhibit::ResetOffer reset_;
    exhibit::CopyOffer copy_;
    sound::Volume volume_;
    double light_ = 1.0;                   ///< 0: asleep
    std::optional<drift::ShownMark> mark_; ///< wanted in this step
    Viewfinder* viewfinder_ = nullptr;     ///< none: the staff's buttons are not held
    tracking::TrackerSignal prop_signal_, head_signal_;
    double gain_db_;                   ///< the settings' volume for this hour
    std::unique_ptr<StaffShow> staff_; ///< while the staff picture is on
    std::optional<int> presents_;      ///< since the other picture was last drawn; nothing: never
};

} // namespace frustumscreen::show
