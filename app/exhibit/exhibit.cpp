#include "app/exhibit/exhibit.h"

#include "app/exhibit/languages.h"
#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>
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
    std::vector<std::vector<glm::dvec2>> all;
    for (const CatalogueEntry& entry : catalogue) {
        all.insert(all.end(), entry.caption_sizes_m.begin(), entry.caption_sizes_m.end());
        for (const DescriptionShape& description : entry.descriptions) {
            all.push_back(description.largest_m);
        }
    }
    return largest_sizes(all);
}

} // namespace

Exhibit::Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language,
                 MonotonicTime now)
    : catalogue_(std::move(catalogue)), place_(place), selection_(make_selection(catalogue_, language, now)),
      states_(catalogue_.size(), ArtifactState::Ready),
      guide_(place.guidance ? std::optional<Guide>(*place.guidance) : std::nullopt),
      advice_placer_(place.picture_m), placer_(place.picture_m), labels_(place.picture_m) {
    for (const AdviceLanguage& words : place_.words) {
        word_languages_.push_back(words.language);
    }
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
    if (staff_until_ && now >= *staff_until_) {
        staff_until_.reset();
    }
    leave_out_the_bad(now);
    for (const Command command : commands) {
        take(command, now);
    }
    if (!attract_) {
        attract_.emplace(place_.attract_place_m, situation.prop_known, now);
    }
    const Stand stand =
        attract_->at(now, situation.prop_known, situation.prop_age, situation.table_from_prop);
    side_.update(situation.eye_m);
    step_table(now, situation, stand);
    const Shown shown = selection_.at(now);

    Presentation presentation;
    presentation.artifact = shown.artifact;
    const StandIn::Output comes = stand_in(now, shown, stand);
    presentation.brightness = comes.brightness * stand.brightness;
    presentation.stand_in = comes.picture;
    presentation.wanted = wanted();
    presentation.language = language_of(shown.artifact);
    guide(now, situation, stand, !commands.empty(), presentation);
    tell(now, situation, shown, stand, !commands.empty(), presentation);
    presentation.caption = caption(now, shown, situation, stand);
    if (presentation.caption && presentation.advice) {
        // One text at a time, or the two would lie on each other.
        presentation.caption->brightness *= 1.0 - presentation.advice->brightness;
    }
    presentation.hotspot = label(now, shown, situation, stand, presentation);
    presentation.table = table_ ? &table_->presented() : nullptr;
    presentation.table_language = shown.language;
    presentation.title_brightness = shown.language_brightness;
    // Pictures invite out of the zone, and its frame would cross them.
    const bool framed = !stand.attracts && !(table_ && table_->presented().count > 0);
    presentation.zone_share = framed ? place_.zone.share(stand.table_from_prop) * stand.brightness : 0.0;
    presentation.table_from_prop = stand.table_from_prop;
    presentation.attracts = stand.attracts;
    const double opacity = placer_.at(now).opacity;
    const bool table_changes = table_ && table_->presented().changing;
    presentation.settled = !table_changes && !labels_.changing() && !shown.changing && !stand.changing &&
                           !comes.waits && !teller_.text().changing && (opacity <= 0.0 || opacity >= 1.0);
    presentation.staff = staff_until_.has_value();
    presentation.lamps = lamps();
    return presentation;
}

void Exhibit::note(std::span<const ArtifactState> states) {
    std::copy_n(states.begin(), std::min(states.size(), states_.size()), states_.begin());
}

void Exhibit::note_triangles(std::size_t artifact, ArtifactTriangles triangles) {
    if (artifact >= catalogue_.size()) {
        return;
    }
    if (artifact != triangles_of_) {
        catalogue_[triangles_of_].hotspots.triangles = {};
    }
    triangles_of_ = artifact;
    catalogue_[artifact].hotspots.triangles = std::move(triangles);
}

void Exhibit::leave_out_the_bad(MonotonicTime now) {
    const auto bad = std::count(states_.begin(), states_.end(), ArtifactState::LeftOut);
    if (static_cast<std::size_t>(bad) == left_out_) {
        return;
    }
    left_out_ = static_cast<std::size_t>(bad);
    for (std::size_t artifact = 0; artifact < states_.size(); ++artifact) {
        if (states_[artifact] == ArtifactState::LeftOut) {
            selection_.leave_out(artifact, now);
            if (table_) {
                table_->leave_out(artifact);
            }
        }
    }
}

bool Exhibit::ready(std::size_t artifact) const {
    return artifact < states_.size() && states_[artifact] == ArtifactState::Ready;
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

/// The prop's place is as large as its bottom, upright for the reader.
StandIn::Output Exhibit::stand_in(MonotonicTime now, const Shown& shown, const Stand& stand) {
    if (catalogue_.empty()) {
        return {0.0, std::nullopt, false};
    }
    const std::size_t chosen = selection_.artifact();
    double half_side_m = 0.0;
    for (const glm::dvec3& corner : std::span(place_.prop.corners).first(place_.prop.corners.size() / 2)) {
        half_side_m = std::max({half_side_m, std::abs(corner.x), std::abs(corner.y)});
    }
    StandIn::Input input{shown,
                         chosen,
                         ready(shown.artifact),
                         ready(chosen),
                         std::nullopt,
                         {glm::dvec2(stand.table_from_prop.translation), glm::dvec2(2.0 * half_side_m),
                          side_.quarter_turns()}};
    if (table_) {
        for (const PlacedPicture& picture : table_->presented().pictures()) {
            if (picture.artifact == chosen) {
                input.from = picture.place.picture;
            }
        }
    }
    StandIn::Output comes = stand_in_.step(now, input);
    if (comes.picture) {
        comes.picture->brightness *= stand.brightness;
    }
    return comes;
}

void Exhibit::take(Command command, MonotonicTime now) {
    if (command == Command::StaffMode) {
        take_chord(now);
        return;
    }
    selected_.at(static_cast<std::size_t>(button_of(command))) = !staff_until_;
    if (staff_until_) {
        staff_until_.reset();
    } else {
        selection_.take(command, now);
        choose_ = choose_ || command == Command::Choose;
        help_ = help_ || command == Command::Help;
    }
}

/// Undoes the presses of the first and the last button, with which the chord began, and switches the staff's
/// mode.
void Exhibit::take_chord(MonotonicTime now) {
    for (const std::size_t button : {std::size_t{0}, place_.buttons - 1}) {
        if (button < selected_.size() && std::exchange(selected_[button], false)) {
            selection_.undo(button_commands[button], now);
        }
    }
    staff_until_ = staff_until_ ? std::nullopt : std::optional(now + staff_time);
}

/// Where nobody knows where the prop is, or in the staff's mode, it rests nowhere.
void Exhibit::step_table(MonotonicTime now, const Situation& situation, const Stand& stand) {
    if (!table_) {
        return;
    }
    TableBrowser::Input input{selection_.artifact(), side_.quarter_turns(),
                              hidden_by_prop(place_.prop, stand.table_from_prop, place_.lens_m), std::nullopt,
                              choose_};
    if (situation.prop_known && !staff_until_) {
        input.prop_m = standing_place(place_.prop, situation.table_from_prop);
    }
    if (const std::optional<std::size_t> chosen = table_->step(now, input)) {
        selection_.choose(*chosen, now);
    }
    choose_ = choose_ && !table_->chose();
    placer_.set_obstacles(table_->obstacles());
    advice_placer_.set_obstacles(table_->obstacles());
}

std::optional<PresentedCaption> Exhibit::caption(MonotonicTime now, const Shown& shown,
                                                 const Situation& situation, const Stand& stand) {
    if (catalogue_.empty() || catalogue_[shown.artifact].languages.empty()) {
        return std::nullopt;
    }
    const CatalogueEntry& entry = catalogue_[shown.artifact];
    const std::size_t language = caption_for(shown.language, entry.languages);
    const CaptionText text = teller_.text();
    const std::vector<glm::dvec2>& sizes =
        text.portion ? entry.descriptions[language].largest_m : entry.caption_sizes_m[language];
    if (placed_ != &sizes) {
        placed_ = &sizes;
        placer_.set_shapes(sizes);
    }
    const RigidTransform& pose = stand.table_from_prop;
    placer_.update(now, hidden_by_prop(place_.prop, pose, place_.lens_m),
                   hidden_by_prop(place_.prop, pose, situation.eye_m), glm::dvec2(pose.translation),
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

/// Beside the pictures and the caption; without words of advice, which say what to do first.
std::optional<PresentedHotspot> Exhibit::label(MonotonicTime now, const Shown& shown,
                                               const Situation& situation, const Stand& stand,
                                               const Presentation& presentation) {
    if (catalogue_.empty() || catalogue_[shown.artifact].languages.empty()) {
        return std::nullopt;
    }
    const CatalogueEntry& entry = catalogue_[shown.artifact];
    std::array<TableRectangle, CaptionPlacer::most_obstacles> obstacles{};
    std::size_t count = 0;
    for (const TableRectangle& place : table_ ? table_->obstacles() : std::span<const TableRectangle>()) {
        obstacles.at(count++) = place;
    }
    if (presentation.caption) {
        obstacles.at(count++) = presentation.caption->rectangle;
    }
    const double advised = presentation.advice ? presentation.advice->brightness : 0.0;
    return labels_.step(
        now, {&entry.hotspots, shown.artifact,
              stand.attracts ? std::nullopt : (presentation.tells_of ? presentation.tells_of : hotspot_),
              caption_for(shown.language, entry.languages),
              shown.caption_brightness * stand.brightness * (1.0 - advised), &place_.prop,
              stand.table_from_prop, situation.eye_m, place_.lens_m, std::span(obstacles).first(count),
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

void Exhibit::tell(MonotonicTime now, const Situation& situation, const Shown& shown, const Stand& stand,
                   bool pressed, Presentation& presentation) {
    TellerInput input;
    input.subject = description_of(selection_.artifact(), selection_.language());
    input.visible = description_of(shown.artifact, shown.language);
    input.tellable = tellable(input.subject);
    input.fades = shown.changing || stand.changing;
    input.attracts = stand.attracts;
    input.there = there_;
    input.pressed = pressed;
    input.next = std::exchange(choose_, false);
    input.help = std::exchange(help_, false);
    input.staff = staff_until_.has_value();
    input.stage = stage_;
    input.narration = narration_;
    const Told& told = teller_.step(now, situation, input);
    presentation.tells_of = told.hotspot;
    presentation.leaves = told.leaves;
    if (told.speaks) {
        presentation.tells = input.subject;
    }
    if (input.tellable != nullptr && !input.tellable->portions.empty()) {
        presentation.prepares = input.subject;
    }
}

/// The sentence in the visitor's language.
std::optional<WordIndex> Exhibit::word_of(const Guidance& guidance) const {
    if (place_.words.empty() || guidance.stage == GuidanceStage::Quiet) {
        return std::nullopt;
    }
    const std::size_t language = caption_for(selection_.language(), word_languages_);
    const std::vector<AdviceText>& texts = place_.words[language].texts;
    const std::string_view key = words_key(guidance);
    const auto found =
        std::find_if(texts.begin(), texts.end(), [&](const AdviceText& text) { return text.key == key; });
    return found != texts.end()
               ? std::optional(WordIndex{language, static_cast<std::size_t>(found - texts.begin())})
               : std::nullopt;
}

void Exhibit::place_advice(MonotonicTime now, const std::optional<WordIndex>& word,
                           const TablePolygon& around, const Situation& situation,
                           Presentation& presentation) {
    if (word != advice_) {
        advice_ = word;
        advice_placer_.set_shapes(
            word ? std::span<const glm::dvec2>(place_.words[word->language].texts[word->text].sizes_m)
                 : std::span<const glm::dvec2>());
    }
    if (!word) {
        return;
    }
    advice_placer_.update(now, around,
                          hidden_by_prop(place_.prop, situation.table_from_prop, situation.eye_m),
                          glm::dvec2(situation.table_from_prop.translation), side_.quarter_turns());
    const CaptionPlace place = advice_placer_.at(now);
    if (place.opacity > 0.0) {
        presentation.advice = {*word, place.shape, place.rectangle, place.opacity};
    }
}

void Exhibit::guide(MonotonicTime now, const Situation& situation, const Stand& stand, bool pressed,
                    Presentation& presentation) {
    there_ = presence_.update(now, situation, pressed);
    stage_ = GuidanceStage::Quiet;
    const bool was_advised = std::exchange(advised_, false);
    if (guide_ && table_ && table_->prop_is_on_picture()) {
        guide_->rest(now); // what is being chosen is no mistake
    } else if (guide_ && there_ && !stand.attracts && situation.prop_known) {
        const GuidedSituation guided{situation.table_from_prop, situation.eye_m};
        // What is heard of a description ends for who asks for help, and otherwise goes on to its next pause.
        const bool describes = teller_.told().portion.has_value();
        if (help_) {
            guide_->ask();
        }
        const Guidance& guidance =
            guide_->step(now, guided, Sensing::Good, !speaking_ || (help_ && describes));
        stage_ = guidance.stage;
        const std::optional<TablePolygon> shadow =
            guidance.stage != GuidanceStage::Quiet
                ? hidden_by_prop(place_.prop, stand.table_from_prop, place_.lens_m)
                : std::nullopt;
        if (shadow) {
            advised_ = true;
            presentation.sign = place_sign(guidance, now, *shadow, place_.picture_m, side_.quarter_turns());
            const TablePolygon around =
                presentation.sign ? hull_of(*shadow, presentation.sign->corners_m) : *shadow;
            const std::optional<WordIndex> word = word_of(guidance);
            presentation.prepares_word = word;
            const bool in_words = guidance.stage >= GuidanceStage::Text && (!describes || help_);
            place_advice(now, in_words ? word : std::nullopt, around, situation, presentation);
            presentation.says = guidance.speak ? word : std::nullopt;
        }
    }
    if (!advised_) {
        place_advice(now, std::nullopt, {}, situation, presentation);
    }
    presentation.falls_silent = was_advised && !advised_;
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
    const Tellable* const told = tellable(description_of(selection_.artifact(), selection_.language()));
    const bool rests_on_picture = table_ && table_->presented().ring;
    const bool helps = stage_ != GuidanceStage::Quiet || (told != nullptr && !told->portions.empty());
    lamps |= told != nullptr || rests_on_picture ? 1U << button_of(Command::Choose) : 0U;
    lamps |= helps ? 1U << button_of(Command::Help) : 0U;
    return lamps;
}

} // namespace frustumscreen
