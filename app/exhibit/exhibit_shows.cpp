// The contents of the presentation, by the exhibit's state.
#include "app/exhibit/exhibit.h"
#include "app/exhibit/languages.h"

#include <algorithm>
#include <limits>

namespace frustumscreen::exhibit {

Presentation Exhibit::present(MonotonicTime now, const tracking::TrackedState& tracked_state,
                              const DrawnPose& drawn, bool pressed) {
    const Shown shown = selection_.at(now);
    Presentation presentation;
    presentation.state = state_;
    presentation.artifact = shown.artifact;
    const Placeholder::Output comes = placeholder(now, shown, drawn);
    presentation.brightness = comes.brightness * drawn.brightness;
    presentation.artifact_light = comes.brightness;
    throw_light(now, tracked_state, shown, drawn, presentation);
    presentation.before = object_dwell_.settled();
    presentation.placeholder = comes.picture;
    presentation.wanted = wanted();
    presentation.wanted_language = selection_.language();
    presentation.language = catalogue_.language(shown.artifact, selection_.language());
    advise(now, tracked_state, drawn, presentation);
    tell(now, tracked_state, shown, drawn, pressed, presentation);
    presentation.caption = caption(now, shown, tracked_state, drawn);
    if (presentation.caption && presentation.advice) {
        // Only one text at a time, so that the two do not overlap.
        presentation.caption->brightness *= std::max(0.0, 1.0 - 2.0 * presentation.advice->brightness);
    }
    presentation.hotspot = label(now, shown, tracked_state, drawn, presentation);
    travel(now, tracked_state, shown, drawn, presentation);
    behave(now, tracked_state, shown, drawn, pressed, presentation);
    place_map(now, tracked_state, shown, drawn, presentation);
    step_windows(now, tracked_state, shown, drawn, presentation);
    presentation.table = table_ ? &table_->presented() : nullptr;
    presentation.table_language = shown.language;
    presentation.title_brightness = shown.language_brightness;
    // Table pictures invite the prop out of the zone, and the zone's frame would cross them.
    const bool framed = !drawn.attracts && !(table_ && table_->presented().count > 0);
    const ZoneFrame& zone = catalogue_.zone(shown.artifact, place_.zone);
    presentation.zone_sides = zone.sides();
    presentation.zone_share = framed ? zone.share(drawn.table_from_prop) * drawn.brightness : 0.0;
    presentation.table_from_prop = drawn.table_from_prop;
    presentation.attracts = drawn.attracts;
    const double opacity = caption_.opacity(now);
    const bool table_changes = table_ && table_->presented().changing;
    presentation.settled = !(windows_ && windows_->changing()) && !table_changes && !labels_.changing() &&
                           !shown.changing && !drawn.changing && !waits() && !narrator_.text().changing &&
                           !title_.changing() && !site_.changing() && !map_.changing() &&
                           (opacity <= 0.0 || opacity >= 1.0);
    dim_what_leaves(now, presentation);
    presentation.staff = state_ == State::Staff;
    presentation.staff_view = staff_.shown();
    presentation.before_staff = staff_.state_before();
    presentation.staff_tones = staff_.tones();
    presentation.louder_db = staff_.louder_db();
    presentation.calibrate = staff_.take_measure();
    presentation.reset = staff_.take_reset();
    presentation.copy = staff_.take_copy();
    presentation.lamps = lamps();
    return presentation;
}

WantedArtifacts Exhibit::wanted() const {
    WantedArtifacts wanted;
    if (catalogue_.all().empty()) {
        return wanted;
    }
    wanted.add(selection_.artifact());
    if (table_ && table_->presented().ring) {
        if (const std::optional<std::size_t> rested =
                table_->presented().places[*table_->presented().ring].artifact) {
            wanted.add(*rested);
        }
    }
    wanted.add(selection_.next());
    wanted.add(selection_.previous());
    if (windows_) {
        for (const PresentedWindow& window : windows_->presented().windows()) {
            wanted.add(window.artifact);
        }
    }
    return wanted;
}

namespace {

/// The area of a standing artifact in the prop: as large as the prop is high, on the reader's half.
typography::TableRectangle place_in(const geometry::PropShape& prop,
                                    const geometry::RigidTransform& table_from_prop, int quarter_turns) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (const glm::dvec3& corner : prop.corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    const glm::dvec2 to_reader(0.0, -0.2 * (high.x - low.x));
    return {glm::dvec2(table_from_prop.translation) + typography::turned(to_reader, quarter_turns),
            glm::dvec2(high.z - low.z), quarter_turns};
}

} // namespace

Placeholder::Output Exhibit::placeholder(MonotonicTime now, const Shown& shown, const DrawnPose& drawn) {
    if (catalogue_.all().empty()) {
        return {0.0, std::nullopt};
    }
    const std::size_t chosen = selection_.artifact();
    Placeholder::Input input{.shown = shown,
                             .chosen = chosen,
                             .shown_ready = catalogue_.ready(shown.artifact),
                             .chosen_ready = catalogue_.ready(chosen),
                             .from = std::nullopt,
                             .to = place_in(place_.prop, drawn.table_from_prop, side_.quarter_turns())};
    if (table_) {
        for (const PlacedPicture& picture : table_->presented().pictures()) {
            if (picture.artifact == chosen) {
                input.from = picture.place.picture;
            }
        }
    }
    Placeholder::Output comes = placeholder_.step(now, input);
    if (!has_artifact()) {
        return {0.0, std::nullopt};
    }
    if (comes.picture) {
        comes.picture->brightness *= drawn.brightness;
    }
    return comes;
}

std::optional<PresentedCaption> Exhibit::caption(MonotonicTime now, const Shown& shown,
                                                 const tracking::TrackedState& tracked_state,
                                                 const DrawnPose& drawn) {
    const CatalogueEntry* const entry = catalogue_.captioned(shown.artifact);
    if (!has_artifact() || entry == nullptr) {
        return std::nullopt;
    }
    return caption_.step(
        now, {.entry = *entry,
              .language = caption_for(shown.language, entry->languages),
              .text = narrator_.text(),
              .light = shown.caption_brightness * drawn.brightness,
              .environment = environment_of(place_, drawn, tracked_state.eye_m, side_.quarter_turns())});
}

Exhibit::Obstacles Exhibit::obstacles_of(const Presentation& presentation) const {
    Obstacles obstacles = lying_on_table();
    if (presentation.caption) {
        obstacles.add(presentation.caption->rectangle);
    }
    if (presentation.hotspot) {
        obstacles.add(presentation.hotspot->label);
    }
    return obstacles;
}

/// The hotspot's label, beside the pictures and the caption. It is dark while advice shows words, which take
/// priority.
std::optional<PresentedHotspot> Exhibit::label(MonotonicTime now, const Shown& shown,
                                               const tracking::TrackedState& tracked_state,
                                               const DrawnPose& drawn, const Presentation& presentation) {
    const CatalogueEntry* const entry = catalogue_.captioned(shown.artifact);
    if (!has_artifact() || entry == nullptr) {
        return std::nullopt;
    }
    const Obstacles obstacles = obstacles_of(presentation);
    const double advised = presentation.advice ? presentation.advice->brightness : 0.0;
    return labels_.step(
        now, {.set = &entry->hotspots,
              .artifact = shown.artifact,
              .hotspot = drawn.attracts || site_.is_away() ? std::nullopt : presentation.tells_of,
              .language = caption_for(shown.language, entry->languages),
              .brightness = shown.caption_brightness * drawn.brightness * (1.0 - advised),
              .prop = &place_.prop,
              .table_from_prop = drawn.table_from_prop,
              .eye_m = tracked_state.eye_m,
              .lens_m = place_.lens_m,
              .picture_edges = place_.picture_edges,
              .obstacles = obstacles.all(),
              .caption = presentation.caption ? std::optional(presentation.caption->rectangle) : std::nullopt,
              .quarter_turns = side_.quarter_turns()});
}

void Exhibit::tell(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                   const DrawnPose& drawn, bool pressed, Presentation& presentation) {
    NarratorInput input;
    input.subject = catalogue_.description(selection_.artifact(), selection_.language());
    input.visible = catalogue_.description(shown.artifact, shown.language);
    input.tellable = note_of(state_).artifact && !leaves_set() ? catalogue_.tellable(input.subject) : nullptr;
    input.fades = shown.changing || drawn.changing || leaves_set();
    input.attracts = drawn.attracts;
    input.there = presence_.is_there() && state_ != State::Attract;
    input.pressed = pressed;
    input.next = presses_.choose();
    input.help = presses_.help() && !guide_.answers();
    input.text_has_place = caption_.opacity(now) > 0.0;
    input.stage = guide_.guidance() != nullptr ? guide_.guidance()->stage : guidance::GuidanceStage::Quiet;
    const Told& told = narrator_.step(now, tracked_state, input);
    presses_.end_choose();
    if (!guide_.answers()) {
        presses_.end_help();
    }
    presentation.tells_of = told.hotspot;
    presentation.leaves = told.leaves;
    if (told.speaks) {
        presentation.tells = input.subject;
    }
    if (input.tellable != nullptr && !input.tellable->portions.empty()) {
        presentation.prepares = input.subject;
    }
}

/// The current state's sentence on the table, in the visitor's language.
std::optional<WordIndex> Exhibit::word() const {
    if (leaves_set()) {
        return std::nullopt; // another set has other texts
    }
    const std::string& language = selection_.language();
    const guidance::Guidance* const guidance = guide_.guidance();
    switch (note_of(state_).words) {
    case Words::Invitation:
        return advice_.find("attract_line", language);
    case Words::Fault:
        return advice_.find("fault.no_artifact", language);
    case Words::Advice: // from the stage at which advice has words
        return guidance != nullptr && guidance->stage >= guidance::GuidanceStage::Text
                   ? advice_.find(guidance::words_key(*guidance), language)
                   : std::nullopt;
    case Words::Narration:
        break;
    case Words::None:
        return torch_says_ ? torch_word() : window_word();
    }
    return std::nullopt;
}

void Exhibit::advise(MonotonicTime now, const tracking::TrackedState& tracked_state, const DrawnPose& drawn,
                     Presentation& presentation) {
    const guidance::Guidance* const guidance = guide_.guidance();
    const AdvicePresenter::Output advice = advice_.step(now, {.note = note_of(state_),
                                                              .guidance = guidance,
                                                              .word = word(),
                                                              .place = place_,
                                                              .drawn = drawn,
                                                              .eye_m = tracked_state.eye_m,
                                                              .quarter_turns = side_.quarter_turns()});
    presentation.sign = advice_.sign();
    presentation.advice = advice.words;
    presentation.says = advice.says;
    presentation.falls_silent = advice.falls_silent;
    if (guidance != nullptr && !leaves_set()) {
        presentation.prepares_word = advice_.find(guidance::words_key(*guidance), selection_.language());
    }
}

std::uint32_t Exhibit::lamps() const {
    if (state_ == State::Staff) {
        return (1U << place_.buttons) - 1U; // each button and its lamp is tested
    }
    std::uint32_t lamps = 0;
    for (std::size_t button = 0; button < settings::button_commands.size(); ++button) {
        lamps |= selection_.accepts(settings::button_commands[button]) ? 1U << button : 0U;
    }
    const Tellable* const told =
        catalogue_.tellable(catalogue_.description(selection_.artifact(), selection_.language()));
    const bool rests = object_dwell_.settled() || (table_ && table_->presented().ring);
    const bool helps = guide_.guidance() != nullptr || (told != nullptr && !told->portions.empty());
    const bool tells = told != nullptr && (state_ != State::Degraded || !told->portions.empty());
    lamps |= tells || rests ? 1U << settings::button_of(settings::Command::Choose) : 0U;
    const CatalogueEntry* const entry = catalogue_.captioned(selection_.artifact());
    const bool behaves = catalogue_.site(selection_.artifact()) != nullptr ||
                         (entry != nullptr && BehaviourTriggers::next(entry->behaviours, 0));
    lamps |= behaves ? 1U << settings::button_of(settings::Command::Behaviour) : 0U;
    lamps |= torch_lamps();
    lamps |= windows_ && windows_->can_pin() ? 1U << settings::button_of(settings::Command::Window) : 0U;
    lamps |= helps ? 1U << settings::button_of(settings::Command::Help) : 0U;
    return lamps;
}

} // namespace frustumscreen::exhibit
