#include "app/exhibit/exhibit.h"

#include "app/exhibit/languages.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace frustumscreen {

namespace {

/// The languages in the order of their first appearance; the button goes through them in this order.
std::vector<std::string> languages_of(const Catalogue& catalogue) {
    std::vector<std::string> languages;
    for (const CatalogueEntry& entry : catalogue) {
        for (const std::string& language : entry.languages) {
            add_language(languages, language);
        }
    }
    return languages;
}

Selection make_selection(const Catalogue& catalogue, const std::string& language, MonotonicTime now) {
    std::vector<std::string> languages = languages_of(catalogue);
    const std::string first = languages.empty() ? language : languages[caption_for(language, languages)];
    return {catalogue.size(), std::move(languages), first, now};
}

/// For each of the widths that captions are wrapped to, the size that holds them all.
std::vector<glm::dvec2> sizes_of_all_captions(const Catalogue& catalogue) {
    std::vector<glm::dvec2> largest;
    for (const CatalogueEntry& entry : catalogue) {
        for (const std::vector<glm::dvec2>& sizes : entry.caption_sizes_m) {
            largest.resize(std::max(largest.size(), sizes.size()), glm::dvec2(0.0));
            for (std::size_t shape = 0; shape < sizes.size(); ++shape) {
                largest[shape] = glm::max(largest[shape], sizes[shape]);
            }
        }
    }
    return largest;
}

/// What the artifact's place hides from a point. An artifact that turns at a place of its own hides the same at any angle, so
/// that nothing beside it moves.
std::optional<TablePolygon> hidden_by(const PropShape& prop, const Stand& stand, const glm::dvec3& from_m) {
    std::optional<TablePolygon> hidden = hidden_by_prop(prop, stand.table_from_prop, from_m);
    if (!hidden || !stand.attracts) {
        return hidden;
    }
    constexpr double eighth = 0.25 * std::numbers::pi;
    TablePolygon all;
    for (const double yaw : {0.0, eighth}) {
        const RigidTransform pose{glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0)),
                                  stand.table_from_prop.translation};
        if (const std::optional<TablePolygon> one = hidden_by_prop(prop, pose, from_m)) {
            all = hull_of(all, one->corners());
        }
    }
    return all;
}

} // namespace

Exhibit::Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language,
                 MonotonicTime now)
    : catalogue_(std::move(catalogue)), place_(place), selection_(make_selection(catalogue_, language, now)),
      state_since_(now), next_turn_(now + turn_time),
      guide_(place.guidance ? std::optional<Guide>(*place.guidance) : std::nullopt),
      sentences_(place.words, place.picture_m), placer_(place.picture_m) {
    if (place.table_pictures) {
        table_.emplace(TableSetUp{.artifacts = catalogue_.size(),
                                  .picture_m = place.picture_m,
                                  .prop = place.prop,
                                  .lens_m = place.lens_m,
                                  .home_m = place.attract_place_m,
                                  .captions_m = sizes_of_all_captions(catalogue_)});
    }
}

Presentation Exhibit::step(MonotonicTime now, std::span<const Command> commands, const Situation& situation) {
    const State before = state_;
    const bool there = presence_.update(now, situation, !commands.empty());
    const bool rests =
        state_ == State::Staff ? now - state_since_ >= staff_time : presence_.rests(now, place_.rest);
    go_to(next(state_, rests ? Event::Rest : Event::VisitorComes), now);
    for (const Command command : commands) {
        take(command, now);
    }
    if (!attract_) {
        attract_.emplace(place_.attract_place_m, situation.prop_known, now);
    }
    const Stand stand =
        attract_->at(now, situation.prop_known, situation.prop_age, situation.table_from_prop);
    side_.update(situation.eye_m);
    go_to(state_after(state_, observe(now, situation, stand, there)), now);
    follow_state(before, now);
    const Shown shown = selection_.at(now);

    Presentation presentation;
    presentation.state = state_;
    presentation.state_before = state_before_;
    presentation.artifact = shown.artifact;
    presentation.brightness = shown.brightness * stand.brightness;
    presentation.language = language_of(shown.artifact);
    present_words(now, situation, stand, presentation);
    presentation.caption = caption(now, shown, situation, stand);
    if (presentation.caption && presentation.advice) {
        // One text at a time, or the two would lie on each other.
        presentation.caption->brightness *= 1.0 - presentation.advice->brightness;
    }
    presentation.table = table_ ? &table_->presented() : nullptr;
    presentation.zone_share =
        stand.attracts ? 0.0 : place_.zone.share(stand.table_from_prop) * stand.brightness;
    presentation.table_from_prop = stand.table_from_prop;
    presentation.attracts = stand.attracts;
    const double opacity = placer_.at(now).opacity;
    const bool table_changes = table_ && table_->presented().changing;
    presentation.settled =
        !table_changes && !shown.changing && !stand.changing && (opacity <= 0.0 || opacity >= 1.0);
    presentation.staff = state_ == State::Staff;
    presentation.lamps = lamps();
    return presentation;
}

void Exhibit::take(Command command, MonotonicTime now) {
    if (command == Command::StaffMode) {
        take_chord(now);
        return;
    }
    const bool counts = state_ != State::Staff;
    selected_.at(static_cast<std::size_t>(button_of(command))) = counts;
    if (counts) {
        selection_.take(command, now);
    }
    go_to(next(state_, Event::Press), now);
}

/// Undoes the presses of the first and the last button, with which the chord began, and switches the staff's
/// mode.
void Exhibit::take_chord(MonotonicTime now) {
    for (const std::size_t button : {std::size_t{0}, place_.buttons - 1}) {
        if (button < selected_.size() && std::exchange(selected_[button], false)) {
            selection_.undo(button_commands[button], now);
        }
    }
    go_to(next(state_, Event::Chord), now);
}

void Exhibit::go_to(State state, MonotonicTime now) {
    if (state != state_) {
        state_before_ = std::exchange(state_, state);
        state_since_ = now;
    }
}

void Exhibit::follow_state(State before, MonotonicTime now) {
    if (state_ != State::Attract) {
        return;
    }
    if (before != State::Attract) { // the visitor has gone
        selection_.reset_language(now);
        sensed_.forget();
        if (guide_) {
            guide_->forget();
        }
        next_turn_ = now + turn_time;
    } else if (now >= next_turn_ && catalogue_.size() > 1) {
        selection_.choose((selection_.artifact() + 1) % catalogue_.size(), now);
        next_turn_ = now + turn_time;
    }
}

Observed Exhibit::observe(MonotonicTime now, const Situation& situation, const Stand& stand, bool there) {
    Observed seen;
    seen.nothing_to_show = catalogue_.empty();
    seen.tracker_lost = attract_->lost();
    step_table(now, situation, stand, seen);
    guidance_ = step_guide(now, situation, stand, there);
    seen.advice_due = guidance_ != nullptr;
    return seen;
}

/// Where nobody knows where the prop is, or in the staff's mode, it rests nowhere.
void Exhibit::step_table(MonotonicTime now, const Situation& situation, const Stand& stand, Observed& seen) {
    if (!table_) {
        return;
    }
    TableBrowser::Input input{selection_.artifact(), side_.quarter_turns(),
                              hidden_by(place_.prop, stand, place_.lens_m), std::nullopt};
    if (situation.prop_known && state_ != State::Staff) {
        input.prop_m = standing_place(place_.prop, situation.table_from_prop);
    }
    const std::optional<std::size_t> chosen = table_->step(now, input);
    seen.prop_rests = table_->presented().ring.has_value();
    seen.artifact_chosen = chosen.has_value();
    if (chosen && state_ != State::Attract) { // there a prop that stands on a picture is nobody's wish
        selection_.choose(*chosen, now);
    }
    placer_.set_obstacles(table_->obstacles());
    sentences_.set_obstacles(table_->obstacles());
}

std::optional<PresentedCaption> Exhibit::caption(MonotonicTime now, const Shown& shown,
                                                 const Situation& situation, const Stand& stand) {
    if (catalogue_.empty() || catalogue_[shown.artifact].languages.empty()) {
        return std::nullopt;
    }
    const CatalogueEntry& entry = catalogue_[shown.artifact];
    const std::size_t language = caption_for(shown.language, entry.languages);
    const std::vector<glm::dvec2>& sizes = entry.caption_sizes_m[language];
    if (placed_ != &sizes) {
        placed_ = &sizes;
        placer_.set_shapes(sizes);
    }
    const RigidTransform& pose = stand.table_from_prop;
    placer_.update(now, hidden_by(place_.prop, stand, place_.lens_m),
                   hidden_by(place_.prop, stand, situation.eye_m), glm::dvec2(pose.translation),
                   side_.quarter_turns());
    const CaptionPlace place = placer_.at(now);
    const double brightness = place.opacity * (shown.caption_brightness * stand.brightness);
    if (brightness <= 0.0) {
        return std::nullopt;
    }
    return PresentedCaption{language, place.shape, place.rectangle, brightness};
}

const Guidance* Exhibit::step_guide(MonotonicTime now, const Situation& situation, const Stand& stand,
                                    bool there) {
    const bool lost = attract_->lost();
    const Sensing sensing = sensed_.update(now, situation, lost, presence_.touched());
    const bool can_be_guided = lost || (situation.prop_known && !stand.attracts);
    if (!guide_ || !there || !can_be_guided || state_ == State::Attract || state_ == State::Staff) {
        return nullptr;
    }
    const bool may_speak = !speaking_ && state_ != State::Browse && state_ != State::Describe;
    const Guidance& guidance =
        guide_->step(now, {situation.table_from_prop, situation.eye_m}, sensing, may_speak);
    return guidance.stage != GuidanceStage::Quiet ? &guidance : nullptr;
}

/// The sentence that this state has on the table, in the visitor's language.
std::optional<WordIndex> Exhibit::word() const {
    switch (note_of(state_).words) {
    case Words::Invitation:
        return sentences_.find("attract_line", selection_.language());
    case Words::Fault:
        return sentences_.find("fault.no_artifact", selection_.language());
    case Words::Advice: // once it is more than a sign
        return guidance_ != nullptr && guidance_->stage >= GuidanceStage::Text
                   ? sentences_.find(words_key(*guidance_), selection_.language())
                   : std::nullopt;
    case Words::Telling:
    case Words::None:
        break;
    }
    return std::nullopt;
}

void Exhibit::present_words(MonotonicTime now, const Situation& situation, const Stand& stand,
                            Presentation& presentation) {
    const StateNote& note = note_of(state_);
    const std::optional<WordIndex> wanted = word();
    const bool signs = note.sign && guidance_ != nullptr;
    SentenceSurroundings surroundings;
    if (signs || wanted || sentences_.busy()) {
        const RigidTransform& pose = stand.table_from_prop;
        surroundings = {hidden_by(place_.prop, stand, place_.lens_m),
                        hidden_by(place_.prop, stand, situation.eye_m), glm::dvec2(pose.translation),
                        side_.quarter_turns()};
    }
    if (signs && surroundings.around) {
        presentation.sign =
            place_sign(*guidance_, now, *surroundings.around, place_.picture_m, side_.quarter_turns());
        if (presentation.sign) {
            surroundings.around = hull_of(*surroundings.around, presentation.sign->corners_m);
        }
    }
    presentation.advice = sentences_.place(now, wanted, surroundings);
    speak(now, wanted, presentation);
}

/// Nothing is heard whose words do not lie on the table.
void Exhibit::speak(MonotonicTime now, const std::optional<WordIndex>& word, Presentation& presentation) {
    if (spoken_ && spoken_ != word) {
        spoken_.reset();
        presentation.falls_silent = true;
    }
    if (guidance_ != nullptr && guidance_->speak && word && note_of(state_).voice &&
        sentences_.shows(now, *word)) {
        presentation.says = word;
        spoken_ = word;
    }
}

void Exhibit::hear(bool speaking) {
    if (speaking_ && !speaking) {
        spoken_.reset();
    }
    speaking_ = speaking;
}

/// The language of the artifact's caption; without captions the chosen one.
std::string_view Exhibit::language_of(std::size_t artifact) const {
    if (artifact >= catalogue_.size() || catalogue_[artifact].languages.empty()) {
        return selection_.language();
    }
    const std::vector<std::string>& languages = catalogue_[artifact].languages;
    return languages[caption_for(selection_.language(), languages)];
}

std::uint32_t Exhibit::lamps() const {
    std::uint32_t lamps = 0;
    for (std::size_t button = 0; button < button_commands.size(); ++button) {
        lamps |= selection_.accepts(button_commands[button]) ? 1U << button : 0U;
    }
    return lamps;
}

} // namespace frustumscreen
