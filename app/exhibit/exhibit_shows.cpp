// The contents of the presentation, by the exhibit's state.
#include "app/exhibit/exhibit.h"
#include "app/exhibit/languages.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen {

Presentation Exhibit::present(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand,
                              bool pressed) {
    const Shown shown = selection_.at(now);
    Presentation presentation;
    presentation.state = state_;
    presentation.state_before = state_before_;
    presentation.artifact = shown.artifact;
    const Placeholder::Output comes = placeholder(now, shown, stand);
    presentation.brightness = comes.brightness * stand.brightness;
    presentation.placeholder = comes.picture;
    presentation.wanted = wanted();
    presentation.wanted_language = selection_.language();
    presentation.language = language_of(shown.artifact);
    present_words(now, tracked_state, stand, presentation);
    sign_ = presentation.sign;
    tell(now, tracked_state, shown, stand, pressed, presentation);
    presentation.caption = caption(now, shown, tracked_state, stand);
    if (presentation.caption && presentation.advice) {
        // Only one text at a time, so that the two do not overlap.
        presentation.caption->brightness *= std::max(0.0, 1.0 - 2.0 * presentation.advice->brightness);
    }
    presentation.hotspot = label(now, shown, tracked_state, stand, presentation);
    presentation.table = table_ ? &table_->presented() : nullptr;
    presentation.table_language = shown.language;
    presentation.title_brightness = shown.language_brightness;
    // Table pictures invite the prop out of the zone, and the zone's frame would cross them.
    const bool framed = !stand.attracts && !(table_ && table_->presented().count > 0);
    const ZoneFrame& zone = zone_of(shown.artifact);
    presentation.zone_sides = zone.sides();
    presentation.zone_share = framed ? zone.share(stand.table_from_prop) * stand.brightness : 0.0;
    presentation.table_from_prop = stand.table_from_prop;
    presentation.attracts = stand.attracts;
    const double opacity = placer_.at(now).opacity;
    const bool table_changes = table_ && table_->presented().changing;
    presentation.settled = !table_changes && !labels_.changing() && !shown.changing && !stand.changing &&
                           !comes.waits && !narrator_.text().changing && (opacity <= 0.0 || opacity >= 1.0);
    waits_ = comes.waits;
    dim_what_leaves(now, presentation);
    presentation.staff = state_ == State::Staff;
    presentation.staff_view = staff_.shown();
    presentation.staff_tones = staff_.tones();
    presentation.louder_db = staff_.louder_db();
    presentation.calibrate = staff_.take_measure();
    presentation.reset = staff_.take_reset();
    presentation.lamps = lamps();
    return presentation;
}

const ZoneFrame& Exhibit::zone_of(std::size_t artifact) const {
    const bool has_own = artifact < catalogue_.size() && catalogue_[artifact].zone;
    return has_own ? *catalogue_[artifact].zone : place_.zone;
}

WantedArtifacts Exhibit::wanted() const {
    WantedArtifacts wanted;
    if (catalogue_.empty()) {
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
    return wanted;
}

namespace {

/// The area of a standing artifact in the prop: as large as the prop is high, on the reader's half.
TableRectangle place_in(const PropShape& prop, const RigidTransform& table_from_prop, int quarter_turns) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (const glm::dvec3& corner : prop.corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    const glm::dvec2 to_reader(0.0, -0.2 * (high.x - low.x));
    return {glm::dvec2(table_from_prop.translation) + turned(to_reader, quarter_turns),
            glm::dvec2(high.z - low.z), quarter_turns};
}

} // namespace

Placeholder::Output Exhibit::placeholder(MonotonicTime now, const Shown& shown, const Stand& stand) {
    if (catalogue_.empty()) {
        return {0.0, std::nullopt, false};
    }
    const std::size_t chosen = selection_.artifact();
    Placeholder::Input input{
        shown,         chosen,       ready(shown.artifact),
        ready(chosen), std::nullopt, place_in(place_.prop, stand.table_from_prop, side_.quarter_turns())};
    if (table_) {
        for (const PlacedPicture& picture : table_->presented().pictures()) {
            if (picture.artifact == chosen) {
                input.from = picture.place.picture;
            }
        }
    }
    Placeholder::Output comes = placeholder_.step(now, input);
    if (!has_artifact()) {
        return {0.0, std::nullopt, false};
    }
    if (comes.picture) {
        comes.picture->brightness *= stand.brightness;
    }
    return comes;
}

std::optional<PresentedCaption> Exhibit::caption(MonotonicTime now, const Shown& shown,
                                                 const TrackedState& tracked_state, const Stand& stand) {
    if (!has_artifact() || catalogue_[shown.artifact].languages.empty()) {
        return std::nullopt;
    }
    const CatalogueEntry& entry = catalogue_[shown.artifact];
    const std::size_t language = caption_for(shown.language, entry.languages);
    const CaptionText text = narrator_.text();
    const std::vector<glm::dvec2>& sizes =
        text.portion ? entry.descriptions[language].largest_m : entry.caption_sizes_m[language];
    if (placed_ != &sizes) {
        placed_ = &sizes;
        placer_.set_shapes(sizes);
    }
    const RigidTransform& pose = stand.table_from_prop;
    placer_.update(now, stand_hides(place_.prop, stand, place_.lens_m),
                   stand_hides(place_.prop, stand, tracked_state.eye_m), glm::dvec2(pose.translation),
                   side_.quarter_turns());
    const CaptionPlace place = placer_.at(now);
    const double brightness = place.opacity * (shown.caption_brightness * stand.brightness) * text.brightness;
    if (brightness <= 0.0) {
        return std::nullopt;
    }
    PresentedCaption caption{language, place.shape, place.rectangle, brightness, text.portion};
    if (text.portion) {
        const DescriptionShape& description = entry.descriptions[language];
        caption.rectangle = portion_place(place.rectangle, description.sizes_m[*text.portion][place.shape],
                                          description.flush_right);
    }
    return caption;
}

/// The hotspot's label, beside the pictures and the caption. It is dark while advice shows words, which take
/// priority.
std::optional<PresentedHotspot> Exhibit::label(MonotonicTime now, const Shown& shown,
                                               const TrackedState& tracked_state, const Stand& stand,
                                               const Presentation& presentation) {
    if (!has_artifact() || catalogue_[shown.artifact].languages.empty()) {
        return std::nullopt;
    }
    const CatalogueEntry& entry = catalogue_[shown.artifact];
    std::array<TableRectangle, CaptionPlacer::max_obstacles> obstacles{};
    std::size_t count = 0;
    for (const TableRectangle& place : table_ ? table_->obstacles() : std::span<const TableRectangle>()) {
        obstacles.at(count++) = place;
    }
    if (presentation.caption) {
        obstacles.at(count++) = presentation.caption->rectangle;
    }
    const double advised = presentation.advice ? presentation.advice->brightness : 0.0;
    return labels_.step(
        now, {&entry.hotspots, shown.artifact, stand.attracts ? std::nullopt : presentation.tells_of,
              caption_for(shown.language, entry.languages),
              shown.caption_brightness * stand.brightness * (1.0 - advised), &place_.prop,
              stand.table_from_prop, tracked_state.eye_m, place_.lens_m, std::span(obstacles).first(count),
              presentation.caption ? std::optional(presentation.caption->rectangle) : std::nullopt,
              side_.quarter_turns()});
}

DescriptionIndex Exhibit::description_of(std::size_t artifact, std::string_view language) const {
    const bool named = artifact < catalogue_.size() && !catalogue_[artifact].languages.empty();
    return {artifact, named ? caption_for(language, catalogue_[artifact].languages) : 0};
}

const Tellable* Exhibit::tellable(const DescriptionIndex& description) const {
    if (description.artifact >= catalogue_.size()) {
        return nullptr;
    }
    const std::vector<Tellable>& tellables = catalogue_[description.artifact].tellables;
    return description.language < tellables.size() && tellables[description.language].count() > 0
               ? &tellables[description.language]
               : nullptr;
}

void Exhibit::tell(MonotonicTime now, const TrackedState& tracked_state, const Shown& shown,
                   const Stand& stand, bool pressed, Presentation& presentation) {
    NarratorInput input;
    input.subject = description_of(selection_.artifact(), selection_.language());
    input.visible = description_of(shown.artifact, shown.language);
    input.tellable = note_of(state_).artifact && !leaves_set() ? tellable(input.subject) : nullptr;
    input.fades = shown.changing || stand.changing || leaves_set();
    input.attracts = stand.attracts;
    input.there = there_ && state_ != State::Attract;
    input.pressed = pressed;
    input.next = std::exchange(choose_, false);
    input.help = help_ && !answer_comes_;
    help_ = answer_comes_;
    input.text_has_place = placer_.at(now).opacity > 0.0;
    input.stage = guidance_ != nullptr ? guidance_->stage : GuidanceStage::Quiet;
    input.narration = narration_;
    const Told& told = narrator_.step(now, tracked_state, input);
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
    switch (note_of(state_).words) {
    case Words::Invitation:
        return sentences_.find("attract_line", selection_.language());
    case Words::Fault:
        return sentences_.find("fault.no_artifact", selection_.language());
    case Words::Advice: // from the stage at which advice has words
        return guidance_ != nullptr && guidance_->stage >= GuidanceStage::Text
                   ? sentences_.find(words_key(*guidance_), selection_.language())
                   : std::nullopt;
    case Words::NarrationSequencer:
    case Words::None:
        break;
    }
    return std::nullopt;
}

void Exhibit::present_words(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand,
                            Presentation& presentation) {
    const StateNote& note = note_of(state_);
    const std::optional<WordIndex> wanted = word();
    const bool signs = note.sign && guidance_ != nullptr;
    SentenceEnvironment environment;
    if (signs || wanted || sentences_.busy()) {
        const RigidTransform& pose = stand.table_from_prop;
        environment = {stand_hides(place_.prop, stand, place_.lens_m),
                       stand_hides(place_.prop, stand, tracked_state.eye_m), glm::dvec2(pose.translation),
                       side_.quarter_turns()};
    }
    if (signs && environment.around) {
        presentation.sign =
            place_sign(*guidance_, now, *environment.around, place_.picture_m, side_.quarter_turns());
        if (presentation.sign) {
            environment.around = hull_of(*environment.around, presentation.sign->corners_m);
        }
    }
    presentation.advice = sentences_.place(now, wanted, environment);
    if (guidance_ != nullptr && !leaves_set()) {
        presentation.prepares_word = sentences_.find(words_key(*guidance_), selection_.language());
    }
    speak(now, wanted, presentation);
}

/// Speech waits until its words are visible on the table.
void Exhibit::speak(MonotonicTime now, const std::optional<WordIndex>& word, Presentation& presentation) {
    if (spoken_ && spoken_ != word) {
        spoken_.reset();
        presentation.falls_silent = true;
    }
    speech_due_ = guidance_ != nullptr &&
                  (guidance_->speak || (speech_due_ && guidance_->stage == GuidanceStage::Voice));
    if (speech_due_ && word && note_of(state_).voice && sentences_.shows(now, *word)) {
        presentation.says = word;
        spoken_ = word;
        speech_due_ = false;
    }
}

/// The language of the artifact's caption; without captions, the chosen language.
std::string_view Exhibit::language_of(std::size_t artifact) const {
    if (artifact >= catalogue_.size() || catalogue_[artifact].languages.empty()) {
        return selection_.language();
    }
    const std::vector<std::string>& languages = catalogue_[artifact].languages;
    return languages[caption_for(selection_.language(), languages)];
}

std::uint32_t Exhibit::lamps() const {
    if (state_ == State::Staff) {
        return (1U << place_.buttons) - 1U; // each button and its lamp is tested
    }
    std::uint32_t lamps = 0;
    for (std::size_t button = 0; button < button_commands.size(); ++button) {
        lamps |= selection_.accepts(button_commands[button]) ? 1U << button : 0U;
    }
    const Tellable* const told = tellable(description_of(selection_.artifact(), selection_.language()));
    const bool rests_on_picture = table_ && table_->presented().ring;
    const bool helps = guidance_ != nullptr || (told != nullptr && !told->portions.empty());
    const bool tells = told != nullptr && (state_ != State::Degraded || !told->portions.empty());
    lamps |= tells || rests_on_picture ? 1U << button_of(Command::Choose) : 0U;
    lamps |= helps ? 1U << button_of(Command::Help) : 0U;
    return lamps;
}

} // namespace frustumscreen
