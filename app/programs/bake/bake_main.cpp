/// frustumscreen-bake: a curator's artifact file to a pack.
#include "app/pack/pack_contents.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_magic.h"
#include "app/pack/sha256.h"
#include "app/programs/bake/artifact_words.h"
#include "app/programs/bake/bake_report.h"
#include "app/programs/bake/bake_request.h"
#include "app/programs/bake/check_hotspots.h"
#include "app/programs/bake/words_command.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/best_turn.h"
#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/folder/new_folder.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/standard_error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {
namespace {

Result<void> describe(Pack& pack, const BakeRequest& request) {
    pack.id = request.id;
    pack.title = request.captions.front().title;
    pack.captions = request.captions;
    for (const PackCaption& caption : pack.captions) {
        pack.languages.push_back(caption.language);
    }
    const Result<Bytes> source = read_file(request.scan);
    if (!source) {
        return tl::unexpected<Error>(source.error());
    }
    pack.provenance.source_name = request.scan.filename().string();
    pack.provenance.source_sha256 = sha256_hex(*source);
    pack.provenance.licence = request.licence;
    return {};
}

/// Without colours an unlit mesh would be one flat area.
bool has_colours(const SourceMesh& mesh) {
    const bool one_colour = std::all_of(mesh.materials.begin(), mesh.materials.end(), [&](const auto& each) {
        return each.base_colour == mesh.materials.front().base_colour;
    });
    return !mesh.textures.empty() || !mesh.colours.empty() || !one_colour;
}

/// With --strict what is lost is an error; otherwise it is said, and said again in the report.
Result<void> tell(const std::vector<SourceNote>& notes, const BakeRequest& request) {
    std::vector<std::string> lost;
    for (const SourceNote& note : notes) {
        if (note.kind == SourceNote::Kind::Lost) {
            lost.push_back(note.text);
        }
    }
    if (request.strict && !lost.empty()) {
        return bad_input(fmt::format("{}: this would be lost, and --strict forbids it: {}",
                                     request.scan.string(), fmt::join(lost, "; ")));
    }
    for (const std::string& text : lost) {
        say_line("frustumscreen-bake", fmt::format("{}: lost: {}", request.scan.string(), text));
    }
    return {};
}

/// Reads the file; its notes say what is lost of it.
Result<SourceMesh> load(const BakeRequest& request) {
    Result<SourceMesh> mesh = load_mesh(request.scan, {request.texture});
    if (!mesh) {
        return mesh;
    }
    if (const Result<void> safe = check_output_is_no_input(request.output, mesh->side_files); !safe) {
        return tl::unexpected<Error>(safe.error());
    }
    if (request.options.unlit && !has_colours(*mesh)) {
        mesh->notes.push_back(
            {SourceNote::Kind::Lost,
             "the relief: the file has no colours, and --unlit makes a flat picture of it; without "
             "--unlit it is lit as in a museum"});
    }
    return mesh;
}

/// What takes seconds comes before what takes minutes, so that what is wrong with it is said at once.
Result<ArtifactWords> set_and_speak(const BakeRequest& request, const BakeOptions& options,
                                    std::vector<SourceNote>& notes) {
    options.progress("texts and speech", 0.0);
    Result<ArtifactWords> words = words_of(request);
    if (!words) {
        return words;
    }
    for (const std::string& lost : words->lost) {
        notes.push_back({SourceNote::Kind::Lost, lost});
    }
    if (const Result<void> told = tell(notes, request); !told) {
        return tl::unexpected<Error>(told.error());
    }
    return words;
}

Result<BakeResult> bake_file(const BakeRequest& request, BakeOptions options) {
    const auto start = std::chrono::steady_clock::now();
    const Result<SourceMesh> mesh = load(request);
    if (!mesh) {
        return tl::unexpected<Error>(mesh.error());
    }
    BakeResult result;
    result.file = request.output;
    result.prop = options.prop;
    result.notes = mesh->notes;
    result.up = options.up.empty() ? std::string(1, mesh->default_up) : options.up;
    result.up_given = !options.up.empty();
    result.turn_given = request.turn_deg.has_value();
    options.turn_deg = result.turn_deg =
        request.turn_deg ? *request.turn_deg
                         : best_turn_deg(*mesh, result.up, options.lift, options.prop.shape);
    if (const Result<void> checked = check_hotspots(*mesh, options); !checked) {
        return tl::unexpected<Error>(checked.error());
    }
    Result<ArtifactWords> words = set_and_speak(request, options, result.notes);
    if (!words) {
        return tl::unexpected<Error>(words.error());
    }
    result.silent = std::move(words->silent);
    Result<Pack> pack = bake(*mesh, options);
    if (!pack) {
        return at(request.scan.string(), pack.error());
    }
    if (const Result<void> described = describe(*pack, request); !described) {
        return tl::unexpected<Error>(described.error());
    }
    put_sounds(*pack, words->spoken);
    put_set_texts(*pack, words->set);
    result.pack = *std::move(pack);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

/// Checks before the work that no scan and no unknown file is overwritten, and that the pack can be written.
Result<void> check_output(const BakeRequest& request) {
    if (Result<void> safe = check_output_is_no_input(request.output, request.inputs); !safe) {
        return safe;
    }
    if (Result<void> place = check_output_place(request.output, room_for_pack(request.options.size));
        !place) {
        return place;
    }
    std::error_code ignored;
    if (!request.force && std::filesystem::exists(request.output, ignored) &&
        !begins_as_pack(request.output)) {
        return bad_input(fmt::format("{}: this file is there and is not a pack; choose another name for the "
                                     "output, or add --force to replace it",
                                     request.output.string()));
    }
    return {};
}

Result<BakeResult> work(const BakeRequest& request) {
    if (Result<void> checked = check_output(request); !checked) {
        return tl::unexpected<Error>(checked.error());
    }
    ProgressLine progress("baking: ");
    BakeOptions options = request.options;
    options.progress = [&](std::string_view step, double done) { progress.show_share(step, done); };
    Result<BakeResult> result = bake_file(request, std::move(options));
    if (!result) {
        return result;
    }
    const Result<Bytes> bytes = write_pack(result->pack);
    if (!bytes) {
        return at(request.output.string(), bytes.error());
    }
    Result<std::vector<PackPart>> parts = list_pack_parts(*bytes);
    if (!parts) {
        return at(request.output.string(), parts.error());
    }
    result->parts = *std::move(parts);
    result->file_bytes = bytes->size();
    if (const Result<void> written = write_file(request.output, *bytes); !written) {
        return tl::unexpected<Error>(written.error());
    }
    return result;
}

/// --new: a folder to start from.
Result<void> start(const BakeArguments& arguments) {
    const Result<SourceMesh> mesh = load_mesh(arguments.input, {arguments.texture});
    if (!mesh) {
        return tl::unexpected<Error>(mesh.error());
    }
    ScanFacts scan{arguments.input, mesh->side_files, mesh->positions.front(), mesh->positions.front(),
                   mesh->default_up};
    for (const glm::dvec3& position : mesh->positions) {
        scan.low = glm::min(scan.low, position);
        scan.high = glm::max(scan.high, position);
    }
    const Result<std::filesystem::path> file = start_folder(arguments.new_folder, scan);
    if (!file) {
        return tl::unexpected<Error>(file.error());
    }
    fmt::print("{}: edit it, then: frustumscreen-bake {} -o {}.fspack\n", file->string(),
               arguments.new_folder.string(), arguments.input.stem().string());
    return {};
}

/// Exit status.
int complain(const Error& error) {
    fmt::print(stderr, "frustumscreen-bake: {}\n", error.message);
    return error.kind == ErrorKind::BadConfiguration ? 2 : 1;
}

int bake_and_report(const BakeArguments& arguments) {
    if (!arguments.new_folder.empty()) {
        const Result<void> started = start(arguments);
        return started ? 0 : complain(started.error());
    }
    const Result<BakeRequest> request = request_of(arguments);
    if (!request) {
        return complain(request.error());
    }
    const Result<BakeResult> done = work(*request);
    if (!done) {
        return complain(done.error());
    }
    fmt::print("{}", arguments.json ? report_json(*done).dump(2) + "\n" : report_text(*done));
    return 0;
}

void add_options(CLI::App& app, BakeArguments& arguments) {
    auto* input =
        app.add_option("INPUT", arguments.input, "artifact file, or a folder with an artifact.toml");
    input->required();
    auto* output = app.add_option("-o,--output", arguments.output, "pack to write (*.fspack)");
    app.add_option(
           "--new", arguments.new_folder,
           "FOLDER to start from the artifact file INPUT: copies it there and writes an artifact.toml to "
           "edit; bakes nothing")
        ->excludes(output);
    app.add_flag("--force", arguments.force, "replace the output also if it is not a pack");
    app.add_option("--size", arguments.size,
                   "texels along the longest edge of a face, 16 to 4096 (default: 512)")
        ->check(CLI::Range(16, 4096));
    app.add_flag("--unlit", arguments.unlit,
                 "base colour alone, no museum light: for colours that already contain light");
    app.add_option("--prop", arguments.prop,
                   "prop whose directions the relief is made for (default: frustum)")
        ->check(CLI::IsMember({"frustum", "cube"}));
    app.add_option("--up", arguments.up, "the file's up axis (default: glTF, OBJ, PLY y; STL z)")
        ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
    app.add_option(
           "--turn", arguments.turn_deg,
           "degrees about the vertical axis, counter-clockwise seen from above; 0 = as the file has it "
           "(default: the largest size and the best side)")
        ->check(CLI::Range(-360.0, 360.0));
    app.add_option(
           "--scale", arguments.scale,
           "factor on the largest size that fits into the prop; above 1 the prop cuts it off (default: 1)")
        ->check(CLI::Range(0.05, 20.0));
    app.add_option(
           "--lift", arguments.lift,
           "raises the artifact above the prop's bottom, in heights of the artifact, 0 to 1 (default: 0)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--texture", arguments.texture,
                   "picture of the colours, where the file names one that is missing, or none");
    app.add_flag("--strict", arguments.strict,
                 "refuse a file of which something would be lost; nothing is written");
    app.add_option(
        "--speech", arguments.speech,
        "program that speaks descriptions without a recording: it takes text on standard input and "
        "writes WAV; {language} in it is replaced; none: no voice (default: espeak-ng)");
    app.add_flag("--json", arguments.json, "the report for programs");
    app.add_option("--title", arguments.title,
                   "title in every language (default: the folder's, else the file's name)");
    app.add_option("--language", arguments.languages, "language of a caption, BCP 47; once for each");
    app.add_option("--caption", arguments.captions, "LANGUAGE=TEXT; once for each language");
    app.add_option("--licence", arguments.licence, "licence of the artifact");
}

int run(int argc, char** argv) {
    if (asks_for_words(argc, argv)) {
        return words_command(argc, argv);
    }
    BakeArguments arguments;
    CLI::App app(
        "Bakes an artifact (glTF, OBJ, PLY, STL) into a pack for the FrustumScreen. Options stand above "
        "what a folder's artifact.toml says.",
        "frustumscreen-bake");
    app.set_version_flag("--version", FRUSTUMSCREEN_VERSION);
    app.footer("frustumscreen-bake --words bakes the exhibit's own words instead; --words --help says more.");
    add_options(app, arguments);
    try {
        app.parse(argc, argv);
        if (arguments.output.empty() && arguments.new_folder.empty()) {
            throw CLI::RequiredError("--output");
        }
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        return bake_and_report(arguments);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "frustumscreen-bake: {}: not enough memory; try a smaller --size\n",
                   arguments.input.string());
        return 1;
    }
}

} // namespace
} // namespace frustumscreen

int main(int argc, char** argv) {
    return frustumscreen::guarded_main("frustumscreen-bake", frustumscreen::run, argc, argv);
}
