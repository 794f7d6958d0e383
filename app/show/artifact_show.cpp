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

constexpr double warm_up_step_m = 0.01;
constexpr double sample_side_m = 0.05;

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

Result<std::unique_ptr<ArtifactShow>> ArtifactShow::create(const settings::Settings& settings,
                                                           const scene::DevicePlan& devices,
                                                           const ArtifactShowOptions& options,
                                                           const render::RenderTarget& target) {
    const PixelSize picture = scene::stereo_layout(settings).display;
    TRY(render::Renderer renderer, render::Renderer::create(picture.width, picture.height));
    std::unique_ptr<ArtifactShow> show(new ArtifactShow(settings, std::move(renderer)));
    show->set_options_ = {.technique = options.technique,
                          .samples = options.samples,
                          .cull_kinds = options.cull_kinds,
                          .program = options.program,
                          .waits = options.waits,
                          .devices = devices,
                          .max_blocks_on_gpu = display::draws_on_processor(display::gl_driver_name())
                                                   ? 0
                                                   : render::max_blocks_on_gpu()};
    TRY_VOID(show->upload_what_stays(settings));
    TRY(show->set_, open_set(settings, show->set_options(),
                             {.number = options.set_number,
                              .packs = options.packs,
                              .packs_key = options.packs_key,
                              .attract = options.attract},
                             std::nullopt));
    show->needs_ = show->set_->needs;
    if (options.other_sets) {
        const bool blocks =
            show->set_options_.max_blocks_on_gpu > 0 || options.technique.ends_with(scene::on_gpu_suffix);
        show->needs_ =
            scene::united(show->needs_, residency::needs_of_any_pack(settings, options.samples, blocks));
        show->may_speak_ = settings.sound.kind != settings::SoundKind::None;
    }
    if (show->windows_) {
        show->needs_ = scene::with_points(std::move(show->needs_));
    }
    TRY_VOID(show->renderer_.prepare(show->needs_));
    TRY_VOID(show->upload_set(options.other_sets));
    if (show->windows_) {
        show->windows_->make_space(*show->set_->artifact_cache);
    }
    show->notes_ = show->set_->notes;
    show->note_language(settings);
    show->measure(settings, target, options.other_sets);
    show->keep_names();
    return show;
}

Result<void> ArtifactShow::upload_what_stays(const settings::Settings& settings) {
    if (settings::shows_zone_frame(settings)) {
        TRY(white_, renderer_.store().upload(image::Image<std::uint8_t>(1, 1, 255)));
    }
    if (settings::tells_of_sticks(settings)) {
        TRY_VOID(notice_.prepare(renderer_.store()));
    }
    if (settings.camera.drift) {
        TRY_VOID(marks_.prepare(renderer_.store()));
    }
    if (settings.torch.exists()) {
        torches_.emplace(settings.torch);
        TRY_VOID(torches_->prepare(renderer_.store()));
    }
    if (settings.windows.exist()) {
        windows_.emplace(settings, prop_, layout_.count, set_options_.waits);
        TRY_VOID(windows_->prepare(renderer_.store()));
    }
    return upload_signs(settings);
}

Result<void> ArtifactShow::upload_set(bool hotspots) {
    render::GpuStore& store = renderer_.store();
    const bool has_site =
        std::any_of(catalogue().begin(), catalogue().end(),
                    [](const exhibit::CatalogueEntry& entry) { return !entry.site.regions.empty(); });
    if (has_site && white_ == scene::TextureId::None) {
        TRY(white_, store.upload(image::Image<std::uint8_t>(1, 1, 255)));
    }
    if (hotspots ||
        std::any_of(catalogue().begin(), catalogue().end(),
                    [](const exhibit::CatalogueEntry& entry) { return !entry.hotspots.hotspots.empty(); })) {
        TRY(hotspots_, residency::HotspotShow::create(store));
    }
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    TRY_VOID(set_->word_pictures.upload(store, all));
    set_->table.upload(store, all);
    return set_->artifact_cache->upload_first(store);
}

std::uint64_t ArtifactShow::planned_bytes_that_stay() const {
    return (white_ != scene::TextureId::None ? scene::caption_gpu_bytes(1, 1) : 0) + planned_sign_bytes_ +
           hotspots_.planned_gpu_bytes() + notice_.planned_gpu_bytes() + marks_.planned_gpu_bytes() +
           (torches_ ? torches_->planned_gpu_bytes() : 0) + (windows_ ? windows_->planned_gpu_bytes() : 0);
}

void ArtifactShow::note_language(const settings::Settings& settings) {
    const std::vector<std::string>& languages = set_->languages;
    if (!settings.exhibit.captions || languages.empty() ||
        exhibit::has_language(languages, settings.exhibit.language)) {
        return;
    }
    const std::vector<std::string>& shown = catalogue().front().languages;
    notes_.push_back(
        fmt::format("no artifact has captions in '{}'; {} is shown; there are {}", settings.exhibit.language,
                    shown.empty() ? settings.exhibit.language
                                  : shown[exhibit::caption_for(settings.exhibit.language, shown)],
                    fmt::join(languages, ", ")));
}

/// Measures at the middle of the table, seen by the default eye. Later artifacts are expected to cost as much as the
/// first one, triangle for triangle and sample for sample.
void ArtifactShow::measure(const settings::Settings& settings, const render::RenderTarget& target,
                           bool other_sets) {
    scene::PlanView view{.projector = layout_.pinhole,
                         .table_from_projector = table_from_projector_,
                         .table_from_prop = {},
                         .eyes_m = {}};
    const std::vector eyes_m(layout_.count, settings.eye.default_m);
    residency::ArtifactCache& artifact_cache = *set_->artifact_cache;
    residency::RunLevels& first = *artifact_cache.find(0);
    const scene::ScenePlan& plan = artifact_cache.known(0).plan;
    view.light = plan.light;
    view.brightness = artifact_cache.exposure(0);
    residency::RunCells* const cells = artifact_cache.find_cells(0);
    if (plan.quality_levels.size() > 1 || artifact_cache.size() > 1 || other_sets || cells != nullptr) {
        const std::array<scene::PlanView, 2> views = scene::views_of(layout_, view, eyes_m);
        first.measure(prop_, std::span(views).first(layout_.count), renderer_, target);
    }
    warm_up(view, eyes_m, target);
    expected_ = {
        .cost = scene::cost_of(first.times()), .prop = prop_, .view = view, .eye_m = settings.eye.default_m};
    if (cells != nullptr) {
        cells->start(expected_.cost);
    }
    artifact_cache.start(expected_.cost, prop_, expected_.view, expected_.eye_m);
    if (windows_) {
        windows_->set_cost(expected_.cost);
    }
}

/// Draws a whole picture and one that redraws only what moved, each with one of every picture on the table: drivers
/// compile on first use, and this should happen before the first frame.
void ArtifactShow::warm_up(scene::PlanView view, std::span<const glm::dvec3> eyes_m,
                           const render::RenderTarget& target) {
    if (const std::vector<std::vector<glm::dvec2>>& sizes = catalogue().front().caption_sizes_m;
        !sizes.empty()) {
        for (std::size_t language = 0; language < sizes.size() && !view.caption; ++language) {
            if (const residency::LoadedTexts* const caption =
                    set_->artifact_cache->texts(0, residency::TextPart::Caption, language)) {
                view.caption = scene::TablePicture{
                    .corners_m = residency::picture_corners({attract_place_m_, sizes[language].front()}),
                    .brightness = 1.0,
                    .texture = caption->texture(0)};
            }
        }
    }
    on_table_.clear();
    set_->table.place_samples(attract_place_m_, on_table_);
    const std::vector<std::vector<AdviceWord>>& words = set_->words.words;
    const scene::TextureId word =
        !words.empty() && !words.front().empty() ? set_->word({}, 0) : scene::TextureId::None;
    const auto [ring, notice] = notice_.samples();
    const scene::TextureId spot = torches_ ? torches_->spot() : scene::TextureId::None;
    for (const scene::TextureId texture :
         {white_, ring, notice, marks_.texture(), signs_.front(), word, spot}) {
        if (texture != scene::TextureId::None) {
            on_table_.add(
                {.corners_m = residency::picture_corners({attract_place_m_, glm::dvec2(sample_side_m)}),
                 .brightness = 1.0,
                 .texture = texture});
        }
    }
    view.on_table = on_table_.pictures();
    if (torches_) {
        view.torches = torches_->sample(attract_place_m_);
    }
    residency::RunLevels& levels = *set_->artifact_cache->find(0);
    if (windows_) {
        view.windows = windows_->sample(levels.shown(), attract_place_m_, eyes_m.front());
    }
    const LentSpace lent(windows_ ? &*windows_ : nullptr, levels.plans());
    render::RenderTarget drawn = target;
    for (const render::Redraw redraw : {render::Redraw::Everything, render::Redraw::Changes}) {
        const std::array<scene::PlanView, 2> views = scene::views_of(layout_, view, eyes_m);
        static_cast<void>(
            levels.draw({}, prop_, std::span(views).first(layout_.count), renderer_, drawn, redraw));
        drawn.buffer_age = 1;
        view.table_from_prop.translation.x += warm_up_step_m;
    }
    render::wait_until_drawn();
}

ArtifactShow::ArtifactShow(const settings::Settings& settings, render::Renderer renderer)
    : projector_(settings.projector.pinhole), layout_(scene::stereo_layout(settings)),
      table_from_projector_(settings.projector.table_from_projector),
      prop_(settings::make_prop(settings.prop)), caption_brightness_(settings.exhibit.caption_brightness),
      renderer_(std::move(renderer)), names_{settings.exhibit.language}, attract_place_m_(0.0),
      picture_m_(settings::picture_on_table(settings, 0.0)),
      dark_(layout_.count, scene::make_plan(prop_, 0, 1)) {
    const settings::Rectangle zone = settings::lit_rectangle(settings);
    attract_place_m_ = zone.centre_m;
    if (settings::shows_zone_frame(settings)) {
        zone_ = exhibit::ZoneFrame(zone, 0.5 * settings.prop.base_m,
                                   {settings.table.width_m, settings.table.depth_m});
    }
}

Result<void> ArtifactShow::upload_signs(const settings::Settings& settings) {
    if (!settings::guides_visitors(settings)) {
        return {};
    }
    const double texels_per_m = residency::text_style(settings).texels_per_m;
    for (std::size_t k = 0; k < signs_.size(); ++k) {
        const image::Image<std::uint8_t> picture =
            exhibit::sign_picture(static_cast<exhibit::Sign>(k), texels_per_m);
        TRY(const scene::TextureId texture, renderer_.store().upload(picture));
        signs_.at(k) = texture;
        planned_sign_bytes_ += scene::caption_gpu_bytes(picture.width, picture.height);
    }
    return {};
}

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
        view.windows = windows->place(presentation, eyes_m, artifact_cache, view.torches);
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
    if (cells != nullptr && cells->shows()) {
        levels.level = residency::level_of_cells;
        levels.error = cells->error();
    }
    levels.technique = kept(levels.technique);
    levels.switches = past_switches_ + artifact_cache.switches();
    levels.ignored_times = past_ignored_times_ + artifact_cache.ignored_times();
    ShowState state{.artifact = kept(artifact_cache.known(presentation.artifact).outline.description.title),
                    .language = kept(presentation.language),
                    .levels = levels,
                    .settled = presentation.settled && (cells == nullptr || !cells->fades())};
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
