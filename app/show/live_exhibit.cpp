#include "app/show/live_exhibit.h"

#include "app/show/mark_show.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <utility>

namespace frustumscreen::show {

namespace {

ToldText told_by(const exhibit::Presentation& presentation) {
    if (presentation.caption && presentation.caption->portion) {
        return {ToldText::Kind::Description, *presentation.caption->portion};
    }
    if (presentation.hotspot) {
        return {ToldText::Kind::Label, presentation.hotspot->hotspot};
    }
    return {presentation.advice ? ToldText::Kind::Words : ToldText::Kind::Nothing, 0};
}

/// Dims all parts alike on the way to sleep.
void dim(exhibit::Presentation& presentation, double light) {
    if (light >= 1.0) {
        return;
    }
    presentation.settled = false;
    presentation.brightness *= light;
    presentation.set_share *= light;
    presentation.title_brightness *= light;
    presentation.zone_share *= light;
    const auto dim_part = [light](auto& part) {
        if (part && light > 0.0) {
            part->brightness *= light;
        } else {
            part.reset(); // a dark part is not presented
        }
    };
    dim_part(presentation.placeholder);
    dim_part(presentation.caption);
    dim_part(presentation.sign);
    dim_part(presentation.advice);
    dim_part(presentation.hotspot);
    dim_part(presentation.title);
    dim_part(presentation.notice);
}

} // namespace

sound::Volume volume_of(const settings::SoundSettings& settings) {
    sound::Volume volume{settings.gain_db, {}};
    for (const settings::SoundHour& hour : settings.hours) {
        volume.hours.push_back({hour.from_h, hour.gain_db});
    }
    return volume;
}

LiveExhibit::LiveExhibit(const settings::Settings& settings, std::unique_ptr<PresentationShow> show,
                         exhibit::Exhibit exhibit, std::string driver, residency::PromptReader::Answer answer)
    : settings_(settings), layout_(scene::stereo_layout(settings)), presentation_show_(std::move(show)),
      driver_(std::move(driver)), exhibit_(std::move(exhibit)),
      notice_(settings, answer == residency::PromptReader::Answer::Always ? ImportWatch::Answer::Always
                                                                          : ImportWatch::Answer::WhenReady),
      volume_(volume_of(settings.sound)), gain_db_(settings.sound.gain_db) {
    if (speaks()) {
        speaker_.begin(answer);
    }
}

void LiveExhibit::watch(ArtifactShow& artifacts, std::unique_ptr<LibraryWatch> library) {
    set_switch_ = std::make_unique<SetSwitch>(artifacts, std::move(library));
}

void LiveExhibit::set_room(std::unique_ptr<RoomTaking> room) {
    room_ = std::move(room);
    room_->set_artifacts(presentation_show_->in_prop());
}

void LiveExhibit::step(MonotonicTime now, std::span<const settings::Command> commands,
                       const tracking::TrackedState& on_table) {
    const bool asleep = light_ <= 0.0;
    if (set_switch_ && !asleep && set_switch_->step(now, presentation_.state, exhibit_)) {
        presentation_.artifact = exhibit_.chosen(); // the previous presentation belongs to the old set
        speaker_.forget();
        if (room_) {
            room_->set_artifacts(presentation_show_->in_prop());
        }
    }
    if (room_) {
        exhibit_.note_object(room_->before(now, on_table));
    }
    exhibit_.note(presentation_show_->artifacts());
    exhibit_.note_triangles(presentation_.artifact, presentation_show_->triangles(presentation_.artifact));
    exhibit_.offer_reset(reset_.at(now));
    exhibit_.offer_copy(copy_.is_offered());
    presentation_ = exhibit_.step(now, left_by_notice(now, commands), on_table);
    if (room_) {
        room_->step(now, exhibit_.chosen(), presentation_);
    }
    if (set_switch_ && !asleep) { // a set that was not visible is neither good nor bad
        set_switch_->report(now, presentation_.state);
    }
    notice_.step(now, on_table, presentation_);
    if (const SharedImport& import = notice_.import(); import != import_) {
        import_ = import;
        reset_.take(now, import->report, import->is_old);
        copy_.take(now, import->report, import->is_old);
    }
    dim(presentation_, light_);
    const bool has_space = mark_ && has_space_for_mark(mark_->place_m, presentation_,
                                                       0.5 * std::numbers::sqrt2 * settings_.prop.base_m);
    presentation_show_->set_mark(has_space ? mark_ : std::nullopt);
    follow_staff_mode();
    follow_copy(now);
    speaker_.set_gain_db(gain_db_ + presentation_.louder_db);
    if (asleep) {
        speaker_.fall_silent();
        return;
    }
    if (speaker_.step(presentation_, *presentation_show_, notice_.announcement())) {
        notice_.announced();
    }
}

std::span<const settings::Command> LiveExhibit::left_by_notice(MonotonicTime now,
                                                               std::span<const settings::Command> commands) {
    static constexpr std::array chord{settings::Command::StaffMode};
    if (!notice_.take_press(now, commands)) {
        return commands;
    }
    bool has_chord = false;
    for (const settings::Command command : commands) {
        has_chord = has_chord || command == settings::Command::StaffMode;
        if (settings::is_press(command)) {
            exhibit_.forget_press(command);
        }
    }
    return std::span(chord).first(has_chord ? 1 : 0);
}

void LiveExhibit::hear(const sound::SoundReport& report) {
    speaker_.hear(report);
    exhibit_.hear(speaker_.speaks(), speaker_.narration());
}

ShowState LiveExhibit::state() const {
    ShowState state = presentation_show_->state(presentation_);
    state.told = told_by(presentation_);
    state.set = set_switch_ ? set_switch_->status() : nullptr;
    state.library_hangs = set_switch_ && set_switch_->library_hangs();
    state.import = notice_.import();
    state.used = exhibit_.used();
    state.calibrate = presentation_.calibrate;
    state.reset = presentation_.reset;
    state.copy = presentation_.copy;
    state.louder_db = presentation_.louder_db;
    return state;
}

void LiveExhibit::follow_staff_mode() {
    if (presentation_.staff != (staff_ != nullptr)) {
        presents_ = 0;
        staff_.reset();
        if (presentation_.staff) {
            Result<std::unique_ptr<StaffShow>> made =
                StaffShow::create(settings_, speaks(), driver_, presentation_.before_staff);
            if (!made) {
                say_line("frustumscreen", fmt::format("no picture for the staff: {}", made.error().message));
                exhibit_.end_staff_mode();
                return;
            }
            staff_ = std::move(*made);
        }
    }
}

void LiveExhibit::follow_copy(MonotonicTime now) {
    if (presentation_.copy) {
        copy_.confirm(now);
    }
    const exhibit::CopyState& state = copy_.step(now);
    if (staff_) {
        staff_->set_copy(state);
    }
}

void LiveExhibit::tell(const RunStatus& status) {
    gain_db_ = sound::gain_db_at(volume_, status.hour_of_day);
    if (staff_) {
        staff_->tell(status, gain_db_);
    }
}

render::DrawResult LiveExhibit::draw(MonotonicTime now, const tracking::TrackedState& on_table,
                                     const render::RenderTarget& target, render::Redraw redraw) {
    // A buffer that is older than the change holds the other picture.
    render::RenderTarget own = target;
    if (presents_ && target.buffer_age > *presents_) {
        own.buffer_age = 0;
    }
    if (staff_) {
        staff_->set_viewfinder(viewfinder_);
        staff_->show(now, presentation_.staff_view, prop_signal_, head_signal_);
    }
    const render::DrawResult drawn =
        staff_ ? staff_->draw(now, on_table, own, redraw) : draw_presentation(now, on_table, own, redraw);
    if (presents_ && drawn.drawn) {
        ++*presents_;
    }
    return drawn;
}

render::DrawResult LiveExhibit::draw_presentation(MonotonicTime now, const tracking::TrackedState& on_table,
                                                  const render::RenderTarget& target, render::Redraw redraw) {
    const std::array<glm::dvec3, 2> both_m = tracking::eyes_of(on_table, 1e-3 * settings_.eye.interocular_mm);
    return presentation_show_->draw(now, presentation_, scene::drawn_eyes(layout_, on_table.eye_m, both_m),
                                    target, redraw);
}

void LiveExhibit::record_time(MonotonicTime now, double ms) {
    if (!staff_) {
        presentation_show_->record_time(now, ms);
    }
}

} // namespace frustumscreen::show
