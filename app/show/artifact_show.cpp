#include "app/show/artifact_show.h"

#include "app/exhibit/guidance_setup.h"
#include "app/exhibit/languages.h"
#include "app/render/read_back.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustumscreen {

namespace {

constexpr double warm_up_step_m = 0.01;
constexpr double sample_side_m = 0.05;
/// Type size of what a visitor should do, in those of a caption.
constexpr double advice_em = 1.5;

/// `what`, behind the place that it is about, where there is one.
std::string after(const std::string& place, const std::string& what) {
    return place.empty() ? what : place + ": " + what;
}

/// The message must be complete: some people do not see the lines on standard error before it.
tl::unexpected<Error> nothing_to_show(const std::vector<PackLeftOut>& left_out,
                                      const std::string& packs_key) {
    if (left_out.empty()) {
        return fail(ErrorKind::BadConfiguration,
                    "no pack is named; name packs under [exhibit] packs in the settings or with --packs, and "
                    "make them with frustumscreen-bake");
    }
    const std::string first = left_out.front().pack + ": " + left_out.front().reason;
    return fail(ErrorKind::BadConfiguration,
                after(packs_key, left_out.size() == 1
                                     ? "the pack cannot be shown: " + first
                                     : fmt::format("none of the {} packs can be shown; the first: {}",
                                                   left_out.size(), first)));
}

/// Whether some texture leaves out texels is known when it is read, and by then the shaders must be there.
RenderNeeds with_cut_outs(RenderNeeds needs) {
    for (ShaderKey key : RenderNeeds(needs).draws) {
        key.cut_out = key.pass == ShaderKey::Pass::Surface;
        needs.draws.insert(key);
    }
    return needs;
}

/// What is left for artifacts beside their texts, which stay.
std::uint64_t budget_of(const Settings& settings, std::span<const ArtifactTexts> texts) {
    const auto budget = static_cast<std::uint64_t>(settings.exhibit.memory_mb) * 1'000'000;
    const std::uint64_t taken = std::accumulate(
        texts.begin(), texts.end(), std::uint64_t{0},
        [](std::uint64_t sum, const ArtifactTexts& each) { return sum + each.planned_gpu_bytes(); });
    return budget - std::min(budget, taken);
}

} // namespace

/// What `create` has of the packs that can be shown.
struct ArtifactShow::Opened {
    std::vector<KnownArtifact> known;
    std::vector<ArtifactTexts> texts;
    std::optional<PreparedArtifact> first;
    std::vector<PackLeftOut> left_out;
    RenderNeeds needs;
};

/// Opens all packs, and prepares the first that is good.
ArtifactShow::Opened ArtifactShow::open(const DevicePlan& devices, const ArtifactShowOptions& options,
                                        double deadline_ms, ArtifactOpener& opener) {
    Opened all;
    all.left_out.reserve(options.packs.size());
    const auto leave_out = [&](const std::filesystem::path& file, const Error& error) {
        say_line(options.program, after(options.packs_key, fmt::format("left out: {}", error.message)));
        all.left_out.push_back(pack_left_out(file.string(), error.message));
    };
    for (const std::filesystem::path& file : options.packs) {
        if (!all.known.empty() && !devices.other_packs) {
            break; // no button leads there
        }
        Result<OpenedArtifact> opened = opener.open(file);
        if (!opened) {
            leave_out(file, opened.error());
            continue;
        }
        if (!all.first) {
            Result<PreparedArtifact> first =
                prepare_artifact(opened->known, options.technique, deadline_ms, [] { return false; });
            if (!first) {
                leave_out(file, first.error());
                opener.close(opened->texts);
                continue;
            }
            ScenePlan& plan = opened->known.plan;
            plan.needs = first->levels.needs();
            plan.left_out.insert(plan.left_out.end(), first->levels.left_out().begin(),
                                 first->levels.left_out().end());
            all.first = std::move(*first);
        } else {
            opened->known.plan.needs = with_cut_outs(opened->known.plan.needs);
        }
        all.needs = united(all.needs, opened->known.plan.needs);
        all.known.push_back(std::move(opened->known));
        all.texts.push_back(std::move(opened->texts));
    }
    return all;
}

Result<std::unique_ptr<ArtifactShow>> ArtifactShow::create(const Settings& settings,
                                                           const DevicePlan& devices,
                                                           const ArtifactShowOptions& options,
                                                           const RenderTarget& target) {
    const Pinhole& pinhole = settings.projector.pinhole;
    Result<Renderer> renderer = Renderer::create(pinhole.width, pinhole.height);
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    const double deadline_ms = 1e3 / settings.projector.refresh_hz;
    ArtifactOpener opener(settings,
                          {options.technique, options.samples, options.economies, devices.language,
                           chooses_on_table(settings) && devices.other_packs && options.packs.size() > 1},
                          renderer->store());
    Opened opened = open(devices, options, deadline_ms, opener);
    if (!opened.first) {
        return nothing_to_show(opened.left_out, options.packs_key);
    }
    if (Result<void> ready = renderer->prepare(opened.needs); !ready) {
        return tl::unexpected<Error>(ready.error());
    }
    Result<std::unique_ptr<Residents>> residents = Residents::create(
        {std::move(opened.known), options.technique, deadline_ms, budget_of(settings, opened.texts),
         options.waits, options.program, std::move(opened.left_out)},
        std::move(*opened.first), renderer->store());
    if (!residents) {
        return tl::unexpected<Error>(residents.error());
    }
    std::unique_ptr<ArtifactShow> show(new ArtifactShow(settings, opened.needs, std::move(*renderer),
                                                        std::move(*residents), std::move(opened.texts)));
    if (Result<void> hotspots = show->prepare_hotspots(); !hotspots) {
        return tl::unexpected<Error>(hotspots.error());
    }
    if (shows_zone_frame(settings)) {
        const Result<TextureId> white = show->renderer_.store().upload(Image<std::uint8_t>(1, 1, 255));
        if (!white) {
            return tl::unexpected<Error>(white.error());
        }
        show->white_ = *white;
    }
    if (Result<void> signs = show->upload_signs(settings); !signs) {
        return tl::unexpected<Error>(signs.error());
    }
    show->notes_ = opener.notes();
    show->load_words(settings, devices);
    if (Result<void> table = show->load_table(settings, devices); !table) {
        return tl::unexpected<Error>(table.error());
    }
    show->note_language(settings, opener.languages());
    show->measure(settings, target);
    return show;
}

Result<void> ArtifactShow::prepare_hotspots() {
    if (std::any_of(texts_.begin(), texts_.end(),
                    [](const ArtifactTexts& artifact) { return !artifact.hotspots.set.hotspots.empty(); })) {
        Result<HotspotShow> hotspots = HotspotShow::create(renderer_.store());
        if (!hotspots) {
            return tl::unexpected<Error>(hotspots.error());
        }
        hotspots_ = std::move(*hotspots);
    }
    return {};
}

Result<void> ArtifactShow::load_table(const Settings& settings, const DevicePlan& devices) {
    if (!chooses_on_table(settings) || residents_->size() < 2) {
        return {};
    }
    TableShow::Request request{{}, devices.language};
    for (std::size_t artifact = 0; artifact < residents_->size(); ++artifact) {
        request.packs.push_back(residents_->known(artifact).file);
    }
    Result<TableShow> table = TableShow::load(settings, request, renderer_.store());
    if (!table) {
        return tl::unexpected<Error>(table.error());
    }
    table_ = std::move(*table);
    notes_.insert(notes_.end(), table_.notes().begin(), table_.notes().end());
    return {};
}

void ArtifactShow::note_language(const Settings& settings, const std::vector<std::string>& languages) {
    if (!settings.exhibit.captions || languages.empty() ||
        has_language(languages, settings.exhibit.language)) {
        return;
    }
    const std::vector<std::string>& shown = texts_.front().languages;
    notes_.push_back(fmt::format(
        "no artifact has captions in '{}'; {} is shown; there are {}", settings.exhibit.language,
        shown.empty() ? settings.exhibit.language : shown[caption_for(settings.exhibit.language, shown)],
        fmt::join(languages, ", ")));
}

/// Measures at the middle of the table, seen by the default eye. What comes later is expected to cost what the first
/// artifact does, triangle for triangle and sample for sample.
void ArtifactShow::measure(const Settings& settings, const RenderTarget& target) {
    PlanView view{projector_, table_from_projector_, {}, std::span(&settings.eye.default_m, 1)};
    RunLevels& first = *residents_->find(0);
    const ScenePlan& plan = residents_->known(0).plan;
    view.light = plan.light;
    view.brightness = residents_->exposure(0);
    if (plan.rungs.size() > 1 || residents_->size() > 1) {
        first.measure(prop_, view, renderer_, target);
    }
    warm_up(view, target);
    residents_->start(cost_of(first.times()), prop_, view, settings.eye.default_m);
}

/// Draws a whole picture and one that redraws what moved, each with one of all that lies on the table: drivers compile for what
/// a frame does, and this should be done before the first frame.
void ArtifactShow::warm_up(PlanView view, const RenderTarget& target) {
    if (!texts_.front().captions.empty()) {
        const CaptionPicture& caption = texts_.front().captions.front().front();
        view.caption =
            TablePicture{picture_corners({attract_place_m_, caption.size_m}), 1.0, caption.texture};
    }
    on_table_.clear();
    table_.place_samples(attract_place_m_, on_table_);
    const bool has_words = !words_.words.empty() && !words_.words.front().empty();
    const TextureId word = has_words ? words_.words.front().front().textures.front() : TextureId::None;
    for (const TextureId texture : {white_, signs_.front(), word}) {
        if (texture != TextureId::None) {
            on_table_.add({picture_corners({attract_place_m_, glm::dvec2(sample_side_m)}), 1.0, texture});
        }
    }
    view.on_table = on_table_.pictures();
    RenderTarget drawn = target;
    for (const Redraw redraw : {Redraw::Everything, Redraw::Changes}) {
        static_cast<void>(residents_->find(0)->draw({}, prop_, view, renderer_, drawn, redraw));
        drawn.buffer_age = 1;
        view.table_from_prop.translation.x += warm_up_step_m;
    }
    wait_until_drawn();
}

ArtifactShow::ArtifactShow(const Settings& settings, const RenderNeeds& needs, Renderer renderer,
                           std::unique_ptr<Residents> residents, std::vector<ArtifactTexts> texts)
    : projector_(settings.projector.pinhole), table_from_projector_(settings.projector.table_from_projector),
      prop_(make_prop(settings.prop)), caption_brightness_(settings.exhibit.caption_brightness),
      needs_(needs), renderer_(std::move(renderer)), residents_(std::move(residents)),
      texts_(std::move(texts)), catalogue_(catalogue_of(texts_)), attract_place_m_(0.0),
      dark_(make_plan(prop_, 0, 1)) {
    const Rectangle zone = lit_rectangle(settings);
    attract_place_m_ = zone.centre_m;
    if (shows_zone_frame(settings)) {
        zone_ = ZoneFrame(zone, 0.5 * settings.prop.base_m, {settings.table.width_m, settings.table.depth_m});
    }
}

Result<void> ArtifactShow::upload_signs(const Settings& settings) {
    if (!guides_visitors(settings)) {
        return {};
    }
    const double texels_per_m = projector_.fx / table_from_projector_.translation.z;
    for (std::size_t k = 0; k < signs_.size(); ++k) {
        const Image<std::uint8_t> picture = sign_picture(static_cast<Sign>(k), texels_per_m);
        const Result<TextureId> texture = renderer_.store().upload(picture);
        if (!texture) {
            return tl::unexpected<Error>(texture.error());
        }
        signs_.at(k) = *texture;
        planned_sign_bytes_ += caption_gpu_bytes(picture.width, picture.height);
    }
    return {};
}

void ArtifactShow::load_words(const Settings& settings, const DevicePlan& devices) {
    if (!guides_visitors(settings) || settings.exhibit.words.empty()) {
        return;
    }
    AdviceWordsRequest request{settings.exhibit.words,
                               {settings.exhibit.language},
                               advice_em * settings.exhibit.caption_height_m,
                               projector_.fx / table_from_projector_.translation.z,
                               settings.sound.kind != SoundKind::None};
    for (const ArtifactTexts& artifact : texts_) {
        if (devices.language) {
            request.languages.insert(request.languages.end(), artifact.languages.begin(),
                                     artifact.languages.end());
        }
    }
    Result<AdviceWords> words = load_advice_words(request, renderer_.store());
    if (!words) {
        notes_.push_back("guidance shows signs without words: " + words.error().message);
        return;
    }
    words_ = std::move(*words);
}

bool ArtifactShow::speaks() const {
    const auto is_spoken = [](const auto& made) { return made.recording != nullptr; };
    return std::any_of(words_.words.begin(), words_.words.end(),
                       [&](const std::vector<AdviceWord>& language) {
                           return std::any_of(language.begin(), language.end(), is_spoken);
                       }) ||
           std::any_of(texts_.begin(), texts_.end(), [&](const ArtifactTexts& artifact) {
               return std::any_of(artifact.descriptions.begin(), artifact.descriptions.end(), is_spoken);
           });
}

std::optional<TablePicture> ArtifactShow::place_advice(const Presentation& presentation) const {
    if (!presentation.advice) {
        return std::nullopt;
    }
    const PresentedAdvice& advice = *presentation.advice;
    const AdviceWord& word = words_.words[advice.word.language][advice.word.text];
    return TablePicture{picture_corners(on_pixels(advice.rectangle, projector_, table_from_projector_)),
                        caption_brightness_ * advice.brightness, word.textures[advice.shape]};
}

void ArtifactShow::place_zone_frame(const Presentation& presentation) {
    if (white_ == TextureId::None) {
        return;
    }
    const double brightness = zone_brightness * caption_brightness_ * presentation.zone_share;
    for (const TableRectangle& side : zone_.sides()) {
        on_table_.add({picture_corners(side), brightness, white_});
    }
}

void ArtifactShow::place_hotspot(const Presentation& presentation) {
    if (presentation.hotspot) {
        hotspots_.place(*presentation.hotspot, texts_[presentation.hotspot->artifact].hotspots,
                        caption_brightness_, projector_, table_from_projector_, on_table_);
    }
}

void ArtifactShow::place_signs(const Presentation& presentation) {
    if (presentation.sign) {
        const PlacedSign& sign = *presentation.sign;
        on_table_.add({flat_corners(sign.corners_m), caption_brightness_ * sign.brightness,
                       signs_.at(static_cast<std::size_t>(sign.sign))});
    }
    if (const std::optional<TablePicture> advice = place_advice(presentation)) {
        on_table_.add(*advice);
    }
}

std::optional<TablePicture> ArtifactShow::place_caption(const Presentation& presentation) const {
    if (!presentation.caption) {
        return std::nullopt;
    }
    const PresentedCaption& caption = *presentation.caption;
    const ArtifactTexts& texts = texts_[presentation.artifact];
    const TextureId texture =
        caption.portion ? texts.descriptions[caption.language].portions[*caption.portion][caption.shape]
                        : texts.captions[caption.language][caption.shape].texture;
    return TablePicture{picture_corners(on_pixels(caption.rectangle, projector_, table_from_projector_)),
                        caption_brightness_ * caption.brightness, texture};
}

DrawResult ArtifactShow::draw(MonotonicTime now, const Presentation& presentation, const glm::dvec3& eye_m,
                              const RenderTarget& target, Redraw redraw) {
    residents_->step(renderer_.store(), presentation.artifact, presentation.wanted.artifacts());
    PlanView view{projector_, table_from_projector_, presentation.table_from_prop, std::span(&eye_m, 1)};
    view.light = residents_->known(presentation.artifact).plan.light;
    view.brightness = residents_->exposure(presentation.artifact) * presentation.brightness;
    view.caption = place_caption(presentation);
    on_table_.clear();
    place_zone_frame(presentation);
    table_.place(presentation,
                 hidden_by_prop(prop_, presentation.table_from_prop, table_from_projector_.translation),
                 on_table_);
    if (presentation.stand_in) {
        table_.place_stand_in(*presentation.stand_in, on_table_);
    }
    place_hotspot(presentation);
    place_signs(presentation);
    view.on_table = on_table_.pictures();
    RunLevels* const levels = residents_->find(presentation.artifact);
    if (levels == nullptr) {
        on_.reset();
        plan_frame(prop_, PlacedLevel{}, view, dark_);
        return renderer_.draw(dark_, target, redraw);
    }
    if (on_ != presentation.artifact) {
        levels->enter(now, load_);
        on_ = presentation.artifact;
    }
    return levels->draw(now, prop_, view, renderer_, target, redraw);
}

ShowUse ArtifactShow::use() const {
    ShowUse use;
    use.planned_shaders = shaders_of(needs_);
    use.shaders = renderer_.shaders();
    use.samples = needs_.samples;
    use.planned_gpu_bytes = gpu_bytes(needs_, projector_.width, projector_.height);
    use.planned_gpu_bytes += white_ != TextureId::None ? caption_gpu_bytes(1, 1) : 0;
    use.planned_gpu_bytes += planned_sign_bytes_ + words_.planned_gpu_bytes + table_.planned_gpu_bytes() +
                             hotspots_.planned_gpu_bytes();
    use.gpu_bytes = renderer_.bytes();
    for (std::size_t artifact = 0; artifact < texts_.size(); ++artifact) {
        if (const RunLevels* levels = residents_->find(artifact)) {
            for (const LevelUse& level : levels->uses()) {
                use.planned_gpu_bytes += level.planned_gpu_bytes;
            }
        }
        use.planned_gpu_bytes += texts_[artifact].planned_gpu_bytes();
        use.captions += texts_[artifact].captions.size();
        for (const std::vector<CaptionPicture>& shapes : texts_[artifact].captions) {
            for (const CaptionPicture& shape : shapes) {
                use.caption_gpu_bytes += renderer_.store().bytes(shape.texture);
            }
        }
    }
    return use;
}

void ArtifactShow::record_time(MonotonicTime now, double ms) {
    if (RunLevels* const levels = on_ ? residents_->find(*on_) : nullptr) {
        levels->record_time(now, ms);
        load_ = levels->load();
    }
}

ShowState ArtifactShow::state(const Presentation& presentation) const {
    const RunLevels* const shown = residents_->find(presentation.artifact);
    LevelState levels = shown != nullptr ? shown->state() : LevelState{};
    levels.switches = residents_->switches();
    levels.ignored_times = residents_->ignored_times();
    return {texts_[presentation.artifact].title,
            presentation.language,
            levels,
            presentation.settled,
            presentation.attracts ? std::optional(presentation.table_from_prop) : std::nullopt,
            residents_->left_out(),
            presentation.lamps,
            residents_->ready(),
            residents_->bytes(),
            presentation.state};
}

Exhibit make_exhibit(const Settings& settings, const ArtifactShow& artifacts, MonotonicTime now) {
    const RigidTransform& table_from_projector = settings.projector.table_from_projector;
    ExhibitPlace place{make_prop(settings.prop),
                       table_from_projector.translation,
                       picture_on_table(settings, 0.0),
                       artifacts.zone(),
                       artifacts.attract_place_m(),
                       settings.panel.buttons(),
                       guides_visitors(settings) ? std::optional(guidance_setup(settings)) : std::nullopt,
                       artifacts.words(),
                       chooses_on_table(settings)};
    place.rest = Nanoseconds(std::llround(1e9 * settings.exhibit.rest_s));
    return {artifacts.catalogue(), place, settings.exhibit.language, now};
}

} // namespace frustumscreen
