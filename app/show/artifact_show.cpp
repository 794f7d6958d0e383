#include "app/show/artifact_show.h"

#include "app/exhibit/guidance_setup.h"
#include "app/exhibit/languages.h"
#include "app/pack/pack_file.h"
#include "app/pack/prop_note.h"
#include "app/render/read_back.h"
#include "app/scene/exposure.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "app/show/caption_setter.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr double warm_up_step_m = 0.01;
/// Type size of what a visitor should do, in those of a caption.
constexpr double advice_em = 1.5;

template <typename Artifacts> Catalogue catalogue_of(const Artifacts& artifacts) {
    Catalogue catalogue;
    for (const auto& artifact : artifacts) {
        CatalogueEntry entry{artifact.languages, {}};
        for (const auto& shapes : artifact.captions) {
            std::vector<glm::dvec2>& sizes = entry.caption_sizes_m.emplace_back();
            std::transform(shapes.begin(), shapes.end(), std::back_inserter(sizes),
                           [](const auto& shape) { return shape.size_m; });
        }
        catalogue.push_back(std::move(entry));
    }
    return catalogue;
}

/// Moves a rectangle by less than a pixel so that its top left corner falls on a corner of the projector's
/// pixels: letters that were set pixel for pixel stay crisp.
TableRectangle on_pixels(TableRectangle rectangle, const Pinhole& projector,
                         const RigidTransform& table_from_projector) {
    const glm::dvec3 corner(rectangle.corners()[3], 0.0);
    const std::optional<glm::dvec2> pixel = projector.pixel(table_from_projector.inverse().point(corner));
    if (!pixel) {
        return rectangle;
    }
    const glm::dvec3 ray = table_from_projector.direction(projector.ray(glm::round(*pixel)));
    if (ray.z < 0.0) {
        const glm::dvec3 lens = table_from_projector.translation;
        rectangle.centre_m += glm::dvec2(lens + ray * (lens.z / -ray.z) - corner);
    }
    return rectangle;
}

/// Messages about a pack begin with its file.
PackLeftOut pack_left_out(const std::string& pack, std::string_view message) {
    const std::string place = pack + ": ";
    if (message.substr(0, place.size()) == place) {
        message.remove_prefix(place.size());
    }
    return {pack, std::string(message)};
}

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

std::array<glm::dvec3, 4> picture_corners(const TableRectangle& rectangle) {
    const std::array<glm::dvec2, 4> c = rectangle.corners(); // from low x, low y, counter-clockwise
    return {glm::dvec3(c[3], 0.0), glm::dvec3(c[2], 0.0), glm::dvec3(c[1], 0.0), glm::dvec3(c[0], 0.0)};
}

} // namespace

/// Brings what is needed of packs into the GPU's memory, one after the other. Main memory keeps only what
/// culling needs.
struct ArtifactShow::Loader {
    const Settings& settings;
    const DevicePlan& devices;
    const ArtifactShowOptions& options;
    GpuStore& store;
    CaptionSetter captions = setter_for(settings);
    std::vector<std::string> languages = {}; ///< of all captions of the packs loaded, shown or not
    std::vector<std::string> notes = {};

    [[nodiscard]] Result<Artifact> load(const std::filesystem::path& file) {
        ScenePlan plan;
        const Result<VerifiedPack> pack =
            load_pack(file, [&](const PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
                Result<ScenePlan> made = plan_scene(settings, outline, request(outline));
                if (!made) {
                    return tl::unexpected<Error>(made.error());
                }
                plan = std::move(*made);
                return plan.levels;
            });
        if (!pack) {
            return tl::unexpected<Error>(pack.error());
        }
        Result<RunLevels> levels =
            RunLevels::upload(**pack, plan, options.technique, 1e3 / settings.projector.refresh_hz, store);
        if (!levels) {
            return at(file.string(), levels.error());
        }
        plan.needs = levels->needs();
        plan.left_out.insert(plan.left_out.end(), levels->left_out().begin(), levels->left_out().end());
        for (const PackCaption& caption : (*pack)->captions) {
            add_language(languages, caption.language);
        }
        if (const auto note = note_other_prop(file.string(), **pack, name_of(settings.prop.kind))) {
            notes.push_back(*note);
        }
        const PackLevel& first = (*pack)->levels[plan.rungs.front().level];
        const double exposure =
            exposure_of(first, (*pack)->box_size, (*pack)->textures[first.texture], plan.highlight_code);
        Artifact artifact{(*pack)->title, std::move(plan), std::move(*levels), exposure, {}, {}};
        if (Result<void> set = set_captions(file, **pack, artifact); !set) {
            release(artifact);
            return tl::unexpected<Error>(set.error());
        }
        return artifact;
    }

    void release(Artifact& artifact) {
        artifact.levels.release(store);
        for (const std::vector<CaptionPicture>& shapes : artifact.captions) {
            for (const CaptionPicture& shape : shapes) {
                store.release(shape.texture);
            }
        }
    }

    [[nodiscard]] SceneRequest request(const PackOutline& outline) const {
        SceneRequest request;
        request.technique = options.technique;
        request.room = options.samples;
        request.economies = options.economies;
        request.visibility = visibility_of(settings);
        std::vector<std::string> languages;
        for (const PackCaption& caption : outline.description.captions) {
            request.captions.push_back(languages.size());
            languages.push_back(caption.language);
        }
        if (!devices.language && !languages.empty()) {
            request.captions = {caption_for(settings.exhibit.language, languages)};
        }
        return request;
    }

    static CaptionSetter setter_for(const Settings& settings) {
        const double height_m = settings.projector.table_from_projector.translation.z;
        return {settings.exhibit.caption_height_m, settings.projector.pinhole.fx / height_m};
    }

    /// Reads the glyph runs of the languages that are needed, and no others. Messages begin with the file's name.
    [[nodiscard]] Result<void> set_captions(const std::filesystem::path& file, const Pack& pack,
                                            Artifact& artifact) {
        for (const std::size_t each : artifact.plan.captions) {
            artifact.languages.push_back(pack.captions[each].language);
        }
        const Result<std::vector<SetLanguage>> set = artifact.languages.empty()
                                                         ? std::vector<SetLanguage>()
                                                         : load_set_texts(file, artifact.languages);
        if (!set) {
            return tl::unexpected<Error>(set.error());
        }
        for (const std::size_t each : artifact.plan.captions) {
            const Result<std::vector<CaptionImage>> images = captions.set(pack.captions[each], *set);
            if (!images) {
                return at(file.string(), images.error());
            }
            std::vector<CaptionPicture>& shapes = artifact.captions.emplace_back();
            for (const CaptionImage& image : *images) {
                const Result<TextureId> texture = store.upload(image.coverage);
                if (!texture) {
                    return at(file.string(), texture.error());
                }
                shapes.push_back(
                    {*texture, image.size_m, caption_gpu_bytes(image.coverage.width, image.coverage.height)});
            }
        }
        return {};
    }
};

Result<std::unique_ptr<ArtifactShow>> ArtifactShow::create(const Settings& settings,
                                                           const DevicePlan& devices,
                                                           const ArtifactShowOptions& options,
                                                           const RenderTarget& target) {
    const Pinhole& pinhole = settings.projector.pinhole;
    Result<Renderer> renderer = Renderer::create(pinhole.width, pinhole.height);
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    Loader loader{settings, devices, options, renderer->store()};
    std::vector<Artifact> artifacts;
    artifacts.reserve(options.packs.size());
    std::vector<PackLeftOut> left_out;
    RenderNeeds needs;
    for (const std::filesystem::path& file : options.packs) {
        if (!artifacts.empty() && !devices.other_packs) {
            break; // no button leads there
        }
        Result<Artifact> artifact = loader.load(file);
        if (artifact) {
            needs = united(needs, artifact->plan.needs);
            artifacts.push_back(std::move(*artifact));
        } else {
            say_line(options.program,
                     after(options.packs_key, fmt::format("left out: {}", artifact.error().message)));
            left_out.push_back(pack_left_out(file.string(), artifact.error().message));
        }
    }
    if (artifacts.empty()) {
        return nothing_to_show(left_out, options.packs_key);
    }
    if (Result<void> ready = renderer->prepare(needs); !ready) {
        return tl::unexpected<Error>(ready.error());
    }
    std::unique_ptr<ArtifactShow> show(
        new ArtifactShow(settings, needs, std::move(*renderer), std::move(artifacts)));
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
    show->left_out_ = std::move(left_out);
    show->notes_ = std::move(loader.notes);
    show->load_words(settings, devices);
    if (settings.exhibit.captions && !loader.languages.empty() &&
        !has_language(loader.languages, settings.exhibit.language)) {
        const std::vector<std::string>& shown = show->artifacts_.front().languages;
        show->notes_.push_back(fmt::format(
            "no artifact has captions in '{}'; {} is shown; there are {}", settings.exhibit.language,
            shown.empty() ? settings.exhibit.language : shown[caption_for(settings.exhibit.language, shown)],
            fmt::join(loader.languages, ", ")));
    }
    show->measure(settings, target);
    return show;
}

/// Measures at the middle of the table, seen by the default eye.
void ArtifactShow::measure(const Settings& settings, const RenderTarget& target) {
    PlanView view{projector_, table_from_projector_, {}, std::span(&settings.eye.default_m, 1)};
    for (Artifact& artifact : artifacts_) {
        view.light = artifact.plan.light;
        view.brightness = artifact.exposure;
        artifact.levels.measure(prop_, view, renderer_, target);
        warm_up(artifact, view, target);
    }
}

/// Draws a whole picture and one that redraws what moved, each with a caption: drivers compile for what a
/// frame does, and this should be done before the first frame.
void ArtifactShow::warm_up(Artifact& artifact, PlanView view, const RenderTarget& target) {
    if (!artifact.captions.empty()) {
        const CaptionPicture& caption = artifact.captions.front().front();
        view.caption =
            TablePicture{picture_corners({attract_place_m_, caption.size_m}), 1.0, caption.texture};
    }
    RenderTarget drawn = target;
    for (const Redraw redraw : {Redraw::Everything, Redraw::Changes}) {
        static_cast<void>(artifact.levels.draw({}, prop_, view, renderer_, drawn, redraw));
        drawn.buffer_age = 1;
        view.table_from_prop.translation.x += warm_up_step_m;
    }
    wait_until_drawn();
}

ArtifactShow::ArtifactShow(const Settings& settings, const RenderNeeds& needs, Renderer renderer,
                           std::vector<Artifact> artifacts)
    : projector_(settings.projector.pinhole), table_from_projector_(settings.projector.table_from_projector),
      prop_(make_prop(settings.prop)), caption_brightness_(settings.exhibit.caption_brightness),
      needs_(needs), renderer_(std::move(renderer)), artifacts_(std::move(artifacts)),
      catalogue_(catalogue_of(artifacts_)), attract_place_m_(0.0) {
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
    for (const Artifact& artifact : artifacts_) {
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
    notes_.insert(notes_.end(), words_.notes.begin(), words_.notes.end());
}

bool ArtifactShow::speaks() const {
    return std::any_of(words_.words.begin(), words_.words.end(), [](const std::vector<AdviceWord>& language) {
        return std::any_of(language.begin(), language.end(),
                           [](const AdviceWord& word) { return word.prompt != nullptr; });
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

std::span<const TablePicture> ArtifactShow::place_signs(const Presentation& presentation) {
    std::size_t count = 0;
    const double brightness = zone_brightness * caption_brightness_ * presentation.zone_share;
    if (brightness > 0.0 && white_ != TextureId::None) {
        for (const TableRectangle& side : zone_.sides()) {
            lines_.at(count++) = {picture_corners(side), brightness, white_};
        }
    }
    if (presentation.sign) {
        const PlacedSign& sign = *presentation.sign;
        TablePicture& picture = lines_.at(count++);
        std::transform(sign.corners_m.begin(), sign.corners_m.end(), picture.corners_m.begin(),
                       [](const glm::dvec2& corner) { return glm::dvec3(corner, 0.0); });
        picture.brightness = caption_brightness_ * sign.brightness;
        picture.texture = signs_.at(static_cast<std::size_t>(sign.sign));
    }
    if (const std::optional<TablePicture> advice = place_advice(presentation)) {
        lines_.at(count++) = *advice;
    }
    return std::span(lines_).first(count);
}

std::optional<TablePicture> ArtifactShow::place_caption(const Presentation& presentation) const {
    if (!presentation.caption) {
        return std::nullopt;
    }
    const PresentedCaption& caption = *presentation.caption;
    const CaptionPicture& picture =
        artifacts_[presentation.artifact].captions[caption.language][caption.shape];
    return TablePicture{picture_corners(on_pixels(caption.rectangle, projector_, table_from_projector_)),
                        caption_brightness_ * caption.brightness, picture.texture};
}

DrawResult ArtifactShow::draw(MonotonicTime now, const Presentation& presentation, const glm::dvec3& eye_m,
                              const RenderTarget& target, Redraw redraw) {
    PlanView view{projector_, table_from_projector_, presentation.table_from_prop, std::span(&eye_m, 1)};
    view.light = artifacts_[presentation.artifact].plan.light;
    view.brightness = artifacts_[presentation.artifact].exposure * presentation.brightness;
    view.caption = place_caption(presentation);
    view.lines = place_signs(presentation);
    if (on_ != presentation.artifact) {
        artifacts_[presentation.artifact].levels.enter(now, artifacts_[on_].levels.load());
        on_ = presentation.artifact;
    }
    return artifacts_[on_].levels.draw(now, prop_, view, renderer_, target, redraw);
}

ShowUse ArtifactShow::use() const {
    ShowUse use;
    use.planned_shaders = shaders_of(needs_);
    use.shaders = renderer_.shaders();
    use.samples = needs_.samples;
    use.planned_gpu_bytes = gpu_bytes(needs_, projector_.width, projector_.height);
    use.planned_gpu_bytes += white_ != TextureId::None ? caption_gpu_bytes(1, 1) : 0;
    use.planned_gpu_bytes += planned_sign_bytes_ + words_.planned_gpu_bytes;
    use.gpu_bytes = renderer_.bytes();
    for (const Artifact& artifact : artifacts_) {
        for (const LevelUse& level : artifact.levels.uses()) {
            use.planned_gpu_bytes += level.planned_gpu_bytes;
        }
        use.captions += artifact.captions.size();
        for (const std::vector<CaptionPicture>& shapes : artifact.captions) {
            for (const CaptionPicture& shape : shapes) {
                use.planned_gpu_bytes += shape.planned_gpu_bytes;
                use.caption_gpu_bytes += renderer_.store().bytes(shape.texture);
            }
        }
    }
    return use;
}

void ArtifactShow::record_time(MonotonicTime now, double ms) {
    artifacts_[on_].levels.record_time(now, ms);
}

ShowState ArtifactShow::state(const Presentation& presentation) const {
    const Artifact& artifact = artifacts_[presentation.artifact];
    LevelState levels = artifact.levels.state();
    levels.switches = 0;
    levels.ignored_times = 0;
    for (const Artifact& each : artifacts_) {
        levels.switches += each.levels.state().switches;
        levels.ignored_times += each.levels.state().ignored_times;
    }
    return {artifact.title,
            presentation.language,
            levels,
            presentation.settled,
            presentation.attracts ? std::optional(presentation.table_from_prop) : std::nullopt,
            left_out_,
            presentation.lamps,
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
                       artifacts.words()};
    place.rest = Nanoseconds(std::llround(1e9 * settings.exhibit.rest_s));
    return {artifacts.catalogue(), place, settings.exhibit.language, now};
}

} // namespace frustumscreen
