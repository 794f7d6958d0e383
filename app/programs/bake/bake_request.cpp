#include "app/programs/bake/bake_request.h"

#include "app/pack/pack_text.h"
#include "app/programs/bake/captions_of.h"
#include "app/solid/prop_file.h"
#include "app/solid/shape_of.h"
#include "assets_baked/bake/loaders/film_file.h"
#include "assets_baked/folder/artifact_file.h"
#include "assets_baked/names/find_entry.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace frustumscreen::programs {

namespace {

/// Words of the folder's file in several languages, and their name in messages.
struct Labelled {
    std::string name; ///< hotspots[1]
    std::string key;  ///< labels
    std::vector<pack::PackLabel> labels;
};

std::vector<Labelled> labelled_in(const folder::ArtifactFile& file) {
    std::vector<Labelled> all;
    for (const folder::ArtifactHotspot& hotspot : file.hotspots) {
        all.push_back({fmt::format("hotspots[{}]", all.size()), "labels", hotspot.labels});
    }
    for (std::size_t k = 0; k < file.behaviours.size(); ++k) {
        if (!file.behaviours[k].titles.empty()) { // without any, visitors are told nothing
            all.push_back({fmt::format("behaviours[{}]", k), "titles", file.behaviours[k].titles});
        }
    }
    for (std::size_t k = 0; k < file.torches.size(); ++k) {
        if (!file.torches[k].titles.empty()) {
            all.push_back({fmt::format("torch[{}]", k), "titles", file.torches[k].titles});
        }
    }
    for (std::size_t k = 0; k < file.states.size(); ++k) {
        all.push_back({fmt::format("states[{}]", k), "titles", file.states[k].titles});
    }
    return all;
}

/// Returns a sentence for each label that is missing in a language of `captions`, and for each label in a language
/// without texts. `left_out`: languages that were left out on purpose; their labels give no sentence.
std::vector<std::string> label_notes(std::span<const Labelled> all,
                                     std::span<const pack::PackCaption> captions,
                                     std::span<const std::string> left_out) {
    const auto is_in = [](const std::string& language) {
        return [&](const auto& each) { return each.language == language; };
    };
    std::vector<std::string> notes;
    for (const auto& [name, key, labels] : all) {
        const std::string word = key.substr(0, key.size() - 1);
        for (const pack::PackCaption& caption : captions) {
            if (std::none_of(labels.begin(), labels.end(), is_in(caption.language))) {
                notes.push_back(fmt::format("{} has no {} in '{}', so none is shown there; write {} = "
                                            "\"...\" under {}",
                                            name, word, caption.language, caption.language, key));
            }
        }
        for (const pack::PackLabel& label : labels) {
            const bool has_texts =
                std::any_of(captions.begin(), captions.end(), is_in(label.language)) ||
                std::find(left_out.begin(), left_out.end(), label.language) != left_out.end();
            if (!has_texts) {
                notes.push_back(fmt::format("{} has the {} \"{}\" in '{}', and the artifact has "
                                            "no [[texts]] in that language; write them, or take the {} away",
                                            name, word, printable(label.text, 60), label.language, word));
            }
        }
    }
    return notes;
}

/// The path of an artifact.toml stands for its folder.
BakeArguments with_folder(BakeArguments arguments) {
    std::error_code none;
    if (arguments.input.filename() == folder::artifact_file_name &&
        std::filesystem::is_regular_file(arguments.input, none)) {
        arguments.input = arguments.input.has_parent_path() ? arguments.input.parent_path() : ".";
    }
    return arguments;
}

Result<folder::ArtifactFile> file_of(const BakeArguments& arguments) {
    std::error_code none;
    if (std::filesystem::is_directory(arguments.input, none)) {
        return folder::read_artifact_file(arguments.input);
    }
    folder::ArtifactFile file;
    file.scan = arguments.input;
    return file;
}

/// Checks a text of the command line before the work; writing the pack would refuse it only afterwards.
Result<void> check_text(const std::string& option, std::string_view text, pack::TextShape shape) {
    if (const auto fault = pack::fault_of_text(text, shape)) {
        return fail(ErrorKind::BadConfiguration, "bake.text", "{} '{}': it {}", option, printable(text, 40),
                    *fault);
    }
    return {};
}

Result<void> check_texts(const BakeArguments& arguments) {
    for (const auto& [option, text] : {std::pair("--title", arguments.title),
                                       {"--licence", arguments.licence},
                                       {"--author", arguments.author}}) {
        TRY_VOID(check_text(option, text, pack::TextShape::Line));
    }
    for (const std::string& caption : arguments.captions) {
        TRY_VOID(check_text("--caption", caption, pack::TextShape::Lines));
    }
    return {};
}

constexpr std::string_view prop_file_suffix = ".obj";

/// `word`: of --prop or of artifact.toml.
Result<bake::BakedProp> prop_of(const std::string& word) {
    if (word == "cube") {
        return bake::baked_cube();
    }
    if (word == "frustum") {
        return bake::baked_frustum();
    }
    if (!word.ends_with(prop_file_suffix)) {
        return fail(ErrorKind::BadConfiguration, "bake.prop",
                    "--prop '{}': allowed are frustum, cube and the path of a prop file, which ends in .obj",
                    printable(word, 40));
    }
    TRY(const Bytes bytes, read_file(word, solid::max_obj_bytes));
    TRY(const solid::PropFile file,
        at(printable(word, 4096), solid::parse_standing_prop(as_text(bytes), solid::LengthUnit::Millimetre)));
    return bake::baked_solid(solid::shape_of(file.solid, solid::Underside::Lit));
}

Result<bake::BakeOptions> options_of(const BakeArguments& arguments, const folder::ArtifactFile& file) {
    bake::BakeOptions options;
    options.size = arguments.size.value_or(file.size);
    options.unlit = arguments.unlit || file.unlit;
    options.relief = !arguments.no_relief;
    options.far = arguments.far;
    TRY(options.prop, prop_of(arguments.prop.value_or(file.prop)));
    options.up = arguments.up.value_or(file.up);
    options.scale = arguments.scale.value_or(file.scale);
    options.lift = arguments.lift.value_or(file.lift);
    for (const folder::ArtifactHotspot& hotspot : file.hotspots) {
        options.hotspots.push_back({hotspot.place, hotspot.point_file, hotspot.labels});
    }
    return options;
}

/// Languages of the folder's file that are not baked, because the command line names others.
std::vector<std::string> left_out_of(const folder::ArtifactFile& file,
                                     const std::vector<pack::PackCaption>& captions) {
    std::vector<std::string> languages;
    for (const pack::PackCaption& written : file.texts) {
        const bool is_baked =
            std::any_of(captions.begin(), captions.end(),
                        [&](const pack::PackCaption& each) { return each.language == written.language; });
        if (!is_baked) {
            languages.push_back(written.language);
        }
    }
    return languages;
}

texts::SpeechSources speech_of(const BakeArguments& arguments, const folder::ArtifactFile& file,
                               const std::vector<std::string>& left_out, bool is_folder) {
    texts::SpeechSources sources{
        .recordings = file.recordings, .folder = {}, .left_out = left_out, .voice = std::nullopt};
    if (is_folder) {
        sources.folder = names::find_entry(arguments.input, folder::recordings_folder_name).value_or("");
    }
    if (arguments.speech != "none") {
        sources.voice = arguments.speech.empty() ? texts::Voice() : texts::Voice(arguments.speech);
    }
    return sources;
}

} // namespace

Result<BakeRequest> request_of(const BakeArguments& written) {
    const BakeArguments arguments = with_folder(written);
    TRY_VOID(check_texts(arguments));
    TRY(folder::ArtifactFile file, file_of(arguments));
    const Result<std::vector<pack::PackCaption>> captions = captions_of({.title = arguments.title,
                                                                         .languages = arguments.languages,
                                                                         .texts = arguments.captions,
                                                                         .from_file = file.texts,
                                                                         .usual_title = {}});
    if (!captions) {
        return as_kind(ErrorKind::BadConfiguration, captions.error());
    }
    BakeRequest request;
    request.scan = file.scan;
    request.output = arguments.output;
    request.preview = arguments.preview;
    request.watched = arguments.watched;
    request.inputs = {file.scan};
    const bool is_folder = file.scan != arguments.input;
    if (is_folder) {
        request.folder = arguments.input;
        request.inputs.push_back(arguments.input / folder::artifact_file_name);
    }
    if (!file.texture.empty()) {
        request.inputs.push_back(file.texture);
    }
    if (arguments.prop && arguments.prop->ends_with(prop_file_suffix)) {
        request.inputs.emplace_back(*arguments.prop);
    }
    for (const auto& [language, recording] : file.recordings) {
        request.inputs.push_back(recording);
    }
    for (const folder::ArtifactTorch& content : file.torches) {
        for (const folder::ArtifactTorchStage& stage : content.stages) {
            const std::vector<std::filesystem::path> files =
                stage.file.empty() ? std::vector<std::filesystem::path>() : bake::files_of_film(stage.file);
            request.inputs.insert(request.inputs.end(), files.begin(), files.end());
        }
    }
    for (const folder::ArtifactState& state : file.states) {
        if (state.layer) {
            request.inputs.push_back(state.layer->file);
        }
    }
    request.force = arguments.force;
    request.clean = arguments.clean;
    request.strict = arguments.strict;
    request.texture = arguments.texture.empty() ? file.texture : arguments.texture;
    request.turn_deg = arguments.turn_deg ? arguments.turn_deg : file.turn_deg;
    if (arguments.site || file.site) {
        const int max_triangles = file.site.value_or(folder::ArtifactSite{}).max_triangles;
        request.site = bake::SiteOptions{.max_triangles = static_cast<std::size_t>(max_triangles)};
    }
    request.cells = request.site ? "none" : arguments.cells; // its cells are its regions
    request.behaviours = file.behaviours;
    request.torches = file.torches;
    request.states = file.states;
    TRY(request.options, options_of(arguments, file));
    request.id = file.id;
    request.usual_title = file.scan.stem().string();
    request.rights = {arguments.licence.empty() ? file.licence : arguments.licence,
                      arguments.author.empty() ? file.author : arguments.author, file.source};
    request.captions = *captions;
    const std::vector<std::string> left_out = left_out_of(file, *captions);
    request.lost = label_notes(labelled_in(file), *captions, left_out);
    request.speech = speech_of(arguments, file, left_out, is_folder);
    return request;
}

} // namespace frustumscreen::programs
