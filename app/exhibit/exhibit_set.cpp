// Change to another set of artifacts.
#include "app/exhibit/exhibit.h"
#include "app/exhibit/languages.h"

#include <utility>

namespace frustumscreen::exhibit {

Selection Exhibit::make_selection(const Catalogue& catalogue, const std::string& language,
                                  MonotonicTime now) {
    std::vector<std::string> languages = languages_of(catalogue);
    const std::string first = languages.empty() ? language : languages[caption_for(language, languages)];
    return {catalogue.size(), std::move(languages), first, now};
}

/// Nothing new is told while a set waits, so narration delays the change only for a limited time.
SetChange::Moment Exhibit::moment_for_set(MonotonicTime now) const {
    using Moment = SetChange::Moment;
    if (state_ == State::Staff || state_ == State::Fault) {
        return Moment::Fits;
    }
    if (selection_.at(now).changing || waits()) {
        return Moment::NotYet; // wait until a change between two artifacts has ended
    }
    if (state_ == State::Attract) {
        return selection_.turn_is_due(now) ? Moment::Fits : Moment::NotYet;
    }
    return tells() || advice_.speaking() || state_ == State::Browse ? Moment::Busy : Moment::Fits;
}

void Exhibit::dim_what_leaves(MonotonicTime now, Presentation& presentation) const {
    if (!leaves_set()) {
        return;
    }
    const double share = set_change_.share(now);
    presentation.set_share = share;
    presentation.settled = false;
    presentation.brightness *= share;
    presentation.artifact_light *= share;
    presentation.windows.dim(share);
    const auto dim = [share](auto& part) {
        if (part && share > 0.0) {
            part->brightness *= share;
        } else {
            part.reset(); // a dark part is not presented
        }
    };
    dim(presentation.placeholder);
    dim(presentation.caption);
    dim(presentation.hotspot);
    dim(presentation.advice);
    dim(presentation.title);
}

Catalogue Exhibit::show_set(Catalogue catalogue, std::optional<TableBrowser> table,
                            std::vector<AdviceLanguage> words, std::size_t artifact, MonotonicTime now) {
    // Without a chosen language the house's applies, and another set may have a nearer one.
    const std::string chosen = selection_.is_at_first_language() ? first_language_ : selection_.language();
    guide_.drop_artifact();
    Catalogue before = catalogue_.exchange(std::move(catalogue));
    if (torches_) {
        torches_.emplace(*place_.torch); // what was left on belongs to the set
    }
    if (windows_) {
        windows_.emplace(*place_.windows, place_.picture_m);
        history_.forget();
    }
    selection_ = make_selection(catalogue_.all(), first_language_, now);
    const std::vector<std::string> languages = languages_of(catalogue_.all());
    selection_.begin_with(artifact, languages.empty() ? chosen : languages[caption_for(chosen, languages)],
                          now);
    set_change_ = {};
    presses_ = {};
    placeholder_ = Placeholder();
    table_ = std::move(table);
    object_dwell_ = {};
    caption_ = ArtifactCaption(place_.picture_m);
    labels_ = HotspotLabels(place_.picture_m);
    narrator_ = Narrator();
    triggers_ = BehaviourTriggers();
    title_ = BehaviourTitle(place_.picture_m);
    advice_.set_words(std::move(words), place_.picture_m);
    return before;
}

} // namespace frustumscreen::exhibit
