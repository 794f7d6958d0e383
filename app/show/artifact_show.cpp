#include "app/show/artifact_show.h"

#include "app/exhibit/languages.h"
#include "app/render/block_upload.h"
#include "app/render/read_back.h"
#include "app/scene/window_patches.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "app/show/exhibit_place.h"
#include "firmware_host/display/egl_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::show {

namespace {

void play(MonotonicTime now, const exhibit::BehaviourEvents& behaviours, world::Player& player) {
    if (behaviours.end_all) {
        player.end_all(now);
    }
    for (const exhibit::BehaviourEvent& event : behaviours.events()) {
        switch (event.kind) {
        case exhibit::BehaviourEvent::Kind::Start:
            player.start(event.behaviour, now);
            break;
        case exhibit::BehaviourEvent::Kind::End:
            player.end(event.behaviour, now);
            break;
        case exhibit::BehaviourEvent::Kind::Toggle:
            player.trigger(event.behaviour, now);
            break;
        }
    }
}

} // namespace

void ArtifactShow::keep_names() {
    for (std::size_t artifact = 0; artifact < set_->artifact_cache->size(); ++artifact) {
        names_.insert(set_->artifact_cache->known(artifact).outline.description.title);
    }
    names_.insert(set_->languages.begin(), set_->languages.end());
    names_.insert(set_options_.technique);
}

std::string_view ArtifactShow::kept(std::string_view name) const {
    const auto found = names_.find(name);
    return found != names_.end() ? std::string_view(*found) : std::string_view();
}

Result<void> ArtifactShow::prepare(const ShownSet& set) {
    needs_ = scene::united(needs_, set.needs);
    return renderer_.prepare(needs_);
}

std::unique_ptr<ShownSet> ArtifactShow::exchange(std::unique_ptr<ShownSet> set) {
    past_switches_ += set_->artifact_cache->switches();
    past_ignored_times_ += set_->artifact_cache->ignored_times();
    std::swap(set_, set);
    on_.reset();
    if (windows_) {
        windows_->make_space(*set_->artifact_cache);
    }
    keep_names();
    return set;
}

bool ArtifactShow::speaks() const {
    return may_speak_ || set_->speaks();
}

std::span<const scene::PlacedTorch> ArtifactShow::throw_light(const exhibit::Presentation& presentation) {
    residency::TorchContents* const contents = set_->torch_contents.get();
    if (contents == nullptr) {
        return {};
    }
    const std::optional<std::size_t>& before = contents->artifact();
    if (windows_ && before && *before != presentation.artifact && windows_->shows_contents_of(*before)) {
        contents->step(renderer_.store(), *before, {}); // until the windows' light has faded
        return torches_ ? torches_->place(presentation, *contents) : std::span<const scene::PlacedTorch>();
    }
    const std::span<const std::size_t> layers =
        windows_ ? windows_->layers_of(set_->artifact_cache->known(presentation.artifact))
                 : std::span<const std::size_t>();
    contents->step(renderer_.store(), presentation.artifact, wanted_contents(presentation, *contents).all(),
                   layers);
    if (residency::RunLevels* const levels = set_->artifact_cache->find(presentation.artifact)) {
        if (const std::optional<residency::ReadLayer> layer = contents->take_layer()) {
            Result<void> added = levels->add_layer(renderer_.store(), *layer);
            residency::RunCells* const cells = set_->artifact_cache->find_cells(presentation.artifact);
            if (added && cells != nullptr) {
                added = cells->add_layer(renderer_.store(), *layer);
            }
            contents->note_layer(layer->layer, added);
        }
    }
    return torches_ ? torches_->place(presentation, *contents) : std::span<const scene::PlacedTorch>();
}

bool ArtifactShow::move_cells(MonotonicTime now, const exhibit::Presentation& presentation,
                              residency::RunLevels* levels, residency::RunCells* cells) {
    if (levels == nullptr) {
        on_.reset();
        return false;
    }
    if (on_ != presentation.artifact) {
        levels->enter(now, load_);
        if (cells != nullptr) {
            cells->enter(now);
        }
        on_ = presentation.artifact;
    }
    if (cells == nullptr) {
        return false;
    }
    play(now, presentation.behaviours, cells->player());
    show_site(presentation, *cells);
    return cells->step(now, load_);
}

void ArtifactShow::show_site(const exhibit::Presentation& presentation, residency::RunCells& cells) const {
    cells.show_site(presentation.site.view);
    const exhibit::SiteGround& site = catalogue()[presentation.artifact].site;
    const std::optional<std::size_t>& marked = presentation.site.marked;
    const std::optional<std::size_t> goal = presentation.site.view ? presentation.site.region : marked;
    cells.expect_site(goal && *goal < site.views.size()
                          ? std::optional(residency::RunCells::Goal{*goal, site.views[*goal]})
                          : std::nullopt);
    cells.mark(marked && *marked < site.regions.size() ? std::optional(site.regions[*marked]) : std::nullopt);
}

render::DrawResult ArtifactShow::draw(MonotonicTime now, const exhibit::Presentation& presentation,
                                      std::span<const glm::dvec3> eyes_m, const render::RenderTarget& target,
                                      render::Redraw redraw) {
    residency::ArtifactCache& artifact_cache = *set_->artifact_cache;
    artifact_cache.step(renderer_.store(), {.shown = presentation.artifact,
                                            .shown_language = presentation.table_language,
                                            .wanted = presentation.wanted.artifacts(),
                                            .language = presentation.wanted_language});
    residency::RunLevels* const levels = artifact_cache.find(presentation.artifact);
    residency::RunCells* const cells = artifact_cache.find_cells(presentation.artifact);
    const bool shows_cells = move_cells(now, presentation, levels, cells);
    scene::PlanView view{.projector = layout_.pinhole,
                         .table_from_projector = table_from_projector_,
                         .table_from_prop = presentation.table_from_prop,
                         .eyes_m = {}};
    view.light = artifact_cache.known(presentation.artifact).plan.light;
    view.brightness = artifact_cache.exposure(presentation.artifact) * presentation.brightness;
    view.caption = place_caption(presentation);
    view.torches = throw_light(presentation);
    on_table_.clear();
    if (torches_) {
        torches_->place_spots(presentation, on_table_);
    }
    WindowShow* const windows = windows_ ? &*windows_ : nullptr;
    if (windows != nullptr) {
        view.windows = windows->place(now, presentation, eyes_m, artifact_cache, view.torches);
        windows->place_frames(presentation, caption_brightness_, on_table_);
        place_state_titles(presentation);
    }
    place_zone_frame(presentation);
    set_->table.place(
        presentation,
        typography::hidden_by_prop(prop_, presentation.table_from_prop, table_from_projector_.translation),
        on_table_);
    if (presentation.placeholder) {
        set_->table.place_placeholder(*presentation.placeholder, on_table_);
    }
    place_hotspot(presentation);
    place_title(presentation);
    place_site_map(presentation);
    place_signs(presentation);
    notice_.place(presentation.notice, caption_brightness_, projector_, table_from_projector_, picture_m_,
                  renderer_.store(), on_table_);
    marks_.place(mark_, on_table_);
    view.on_table = on_table_.pictures();
    const std::array<scene::PlanView, 2> views = scene::views_of(layout_, view, eyes_m);
    if (levels == nullptr) {
        const LentSpace lent(windows, dark_);
        for (std::size_t eye = 0; eye < layout_.count; ++eye) {
            scene::plan_frame(prop_, scene::PlacedLevel{}, views[eye], dark_[eye]);
        }
        return renderer_.draw(dark_, target, redraw);
    }
    if (shows_cells) {
        const LentSpace lent(windows, cells->plans());
        return cells->draw(now, levels->shown(), prop_, std::span(views).first(layout_.count), renderer_,
                           target, redraw);
    }
    const LentSpace lent(windows, levels->plans());
    const std::span<const scene::Part> marks =
        cells != nullptr ? cells->marks() : std::span<const scene::Part>();
    return levels->draw(now, prop_, std::span(views).first(layout_.count), renderer_, target, redraw, marks);
}

ShowUse ArtifactShow::use() const {
    ShowUse use;
    use.planned_shaders = scene::shaders_of(needs_);
    use.shaders = renderer_.shaders();
    use.samples = needs_.samples;
    use.planned_gpu_bytes = scene::gpu_bytes(needs_, layout_.display.width, layout_.display.height);
    use.text_gpu_bytes = set_->artifact_cache->uploaded_text_bytes();
    use.planned_gpu_bytes += planned_bytes_that_stay() + set_->planned_gpu_bytes() + use.text_gpu_bytes;
    use.planned_gpu_bytes += set_->torch_contents ? set_->torch_contents->bytes() : 0;
    use.gpu_bytes = renderer_.bytes();
    for (std::size_t artifact = 0; artifact < catalogue().size(); ++artifact) {
        use.captions += catalogue()[artifact].languages.size();
        if (const residency::RunLevels* levels = set_->artifact_cache->find(artifact)) {
            for (const residency::LevelUse& level : levels->uses()) {
                use.planned_gpu_bytes += level.planned_gpu_bytes;
            }
            if (const residency::RunCells* const cells = set_->artifact_cache->find_cells(artifact)) {
                for (const residency::LevelUse& level : cells->uses()) {
                    use.planned_gpu_bytes += level.planned_gpu_bytes;
                }
            }
        }
    }
    return use;
}

void ArtifactShow::record_time(MonotonicTime now, double ms) {
    if (windows_) {
        windows_->record_time(now, ms);
    }
    residency::RunLevels* const levels = on_ ? set_->artifact_cache->find(*on_) : nullptr;
    residency::RunCells* const cells = on_ ? set_->artifact_cache->find_cells(*on_) : nullptr;
    if (cells != nullptr && cells->shows()) {
        cells->record_time(now, ms);
        load_ = cells->load();
    } else if (levels != nullptr) {
        levels->record_time(now, ms);
        load_ = levels->load();
    }
}

ShowState ArtifactShow::state(const exhibit::Presentation& presentation) const {
    const residency::ArtifactCache& artifact_cache = *set_->artifact_cache;
    const residency::RunLevels* const shown = artifact_cache.find(presentation.artifact);
    residency::LevelState levels = shown != nullptr ? shown->state() : residency::LevelState{};
    const residency::RunCells* const cells = artifact_cache.find_cells(presentation.artifact);
    bool fades = cells != nullptr && cells->fades();
    if (cells != nullptr && cells->shows()) {
        levels.level = residency::level_of_cells;
        levels.error = cells->error();
    } else if (shown != nullptr) {
        fades = fades || shown->fades();
    }
    levels.technique = kept(levels.technique);
    levels.switches = past_switches_ + artifact_cache.switches();
    levels.ignored_times = past_ignored_times_ + artifact_cache.ignored_times();
    ShowState state{.artifact = kept(artifact_cache.known(presentation.artifact).outline.description.title),
                    .language = kept(presentation.language),
                    .levels = levels,
                    .settled = presentation.settled && !fades && !(windows_ && windows_->fades())};
    state.stands = presentation.attracts ? std::optional(presentation.table_from_prop) : std::nullopt;
    state.left_out = artifact_cache.left_out();
    state.lamps = presentation.lamps;
    state.loaded = artifact_cache.ready();
    state.loaded_bytes = artifact_cache.bytes();
    state.state = presentation.state;
    if (torches_) {
        state.torch = shown_torch(presentation, set_->torch_contents.get());
    }
    return state;
}

exhibit::Exhibit make_exhibit(const settings::Settings& settings, const ArtifactShow& artifacts,
                              MonotonicTime now) {
    exhibit::ExhibitPlace place = exhibit_place(settings);
    place.zone = artifacts.zone();
    place.words = artifacts.words();
    return {artifacts.catalogue(), place, settings.exhibit.language, now};
}

} // namespace frustumscreen::show
