// Change to another set of artifacts.
#include "app/exhibit/exhibit.h"
#include "app/exhibit/languages.h"
#include "app/geometry/time_curves.h"

#include <algorithm>
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

/// The sizes of one text for `shapes` shapes: its own sizes, repeated.
std::vector<glm::dvec2> repeated(const std::vector<glm::dvec2>& sizes_m, std::size_t shapes) {
    std::vector<glm::dvec2> all;
    for (std::size_t k = 0; k < shapes && !sizes_m.empty(); ++k) {
        all.push_back(sizes_m[k % sizes_m.size()]);
    }
    return all;
}

/// For each shape of a caption, the size that holds all captions. Texts without an attribution, and descriptions,
/// have fewer shapes, for the same widths.
std::vector<glm::dvec2> sizes_of_all_captions(const Catalogue& catalogue) {
    std::vector<std::vector<glm::dvec2>> all;
    for (const CatalogueEntry& entry : catalogue) {
        all.insert(all.end(), entry.caption_sizes_m.begin(), entry.caption_sizes_m.end());
        for (const DescriptionShape& description : entry.descriptions) {
            all.push_back(description.largest_m);
        }
    }
    const std::size_t shapes = largest_sizes(all).size();
    for (std::vector<glm::dvec2>& sizes_m : all) {
        sizes_m = repeated(sizes_m, shapes);
    }
    return largest_sizes(all);
}

} // namespace

Selection Exhibit::make_selection(const Catalogue& catalogue, const std::string& language,
                                  MonotonicTime now) {
    std::vector<std::string> languages = languages_of(catalogue);
    const std::string first = languages.empty() ? language : languages[caption_for(language, languages)];
    return {catalogue.size(), std::move(languages), first, now};
}

std::optional<TableBrowser> lay_out_catalogue(const Catalogue& catalogue, const ExhibitPlace& place) {
    if (!place.table_pictures) {
        return std::nullopt;
    }
    return TableBrowser({.artifacts = catalogue.size(),
                         .picture_m = place.picture_m,
                         .prop = place.prop,
                         .lens_m = place.lens_m,
                         .home_m = place.attract_place_m,
                         .captions_m = sizes_of_all_captions(catalogue)});
}

/// Nothing new is told while a set waits, so narration delays the change only for a limited time.
bool Exhibit::may_leave_set(MonotonicTime now) const {
    if (state_ == State::Staff || state_ == State::Fault) {
        return true;
    }
    if (selection_.at(now).changing || waits_) {
        return false; // wait until a change between two artifacts has ended
    }
    if (state_ == State::Attract) {
        return now >= next_turn_;
    }
    const bool busy = tells() || speaking_ || state_ == State::Browse;
    return !busy || now - *set_waits_since_ >= longest_wait;
}

void Exhibit::follow_set(MonotonicTime now) {
    if (set_is_ready_ && !set_waits_since_) {
        set_waits_since_ = now; // kept while the other set loads an artifact that was chosen meanwhile
    }
    if (set_is_ready_ && !leaves_set() && may_leave_set(now)) {
        set_leaves_since_ = now;
    }
    set_left_ = leaves_set() && now - *set_leaves_since_ >= fade_time;
}

void Exhibit::dim_what_leaves(MonotonicTime now, Presentation& presentation) const {
    if (!leaves_set()) {
        return;
    }
    const double share = 1.0 - ease(to_seconds(now - *set_leaves_since_) / to_seconds(fade_time));
    presentation.set_share = share;
    presentation.settled = false;
    presentation.brightness *= share;
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
}

Catalogue Exhibit::show_set(Catalogue catalogue, std::optional<TableBrowser> table,
                            std::vector<AdviceLanguage> words, std::size_t artifact, MonotonicTime now) {
    // Without a chosen language the house's applies, and another set may have a nearer one.
    const std::string chosen = selection_.is_at_first_language() ? house_language_ : selection_.language();
    Catalogue before = std::exchange(catalogue_, std::move(catalogue));
    if (guide_) {
        guide_->show({}); // drops its pointer to the old catalogue
    }
    selection_ = make_selection(catalogue_, house_language_, now);
    const std::vector<std::string> languages = languages_of(catalogue_);
    selection_.begin_with(artifact, languages.empty() ? chosen : languages[caption_for(chosen, languages)],
                          now);
    ready_.assign(catalogue_.size(), ArtifactState::Ready);
    offered_.assign(catalogue_.size(), true);
    triangles_of_ = 0;
    placeholder_ = Placeholder();
    sentences_ = Sentences(std::move(words), place_.picture_m);
    spoken_.reset();
    speech_due_ = false;
    narration_ = {};
    narrator_ = Narrator();
    choose_ = help_ = answer_comes_ = false;
    table_ = std::move(table);
    placer_ = CaptionPlacer(place_.picture_m);
    placed_ = nullptr;
    labels_ = HotspotLabels(place_.picture_m);
    selected_.fill(false);
    next_turn_ = now + turn_time;
    set_is_ready_ = set_left_ = waits_ = false;
    set_waits_since_.reset();
    set_leaves_since_.reset();
    return before;
}

} // namespace frustumscreen
