/// frustumscreen-bake: a curator's artifact file to a pack.
#include "app/pack/pack_contents.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_magic.h"
#include "app/pack/sha256.h"
#include "app/programs/bake/bake_report.h"
#include "app/programs/bake/captions_of.h"
#include "app/programs/bake/words_command.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/best_turn.h"
#include "assets_baked/bake/load_mesh.h"
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

struct Arguments {
    std::filesystem::path input;
    std::filesystem::path output;
    bool force = false;  ///< replace an output that is no pack
    bool strict = false; ///< what is lost is an error
    bool json = false;
    std::filesystem::path texture;  ///< empty: the model's own pictures
    std::optional<double> turn_deg; ///< nothing: the best
    BakeOptions options;
    std::string prop = "frustum";
    std::string title;
    std::string licence;
    std::vector<std::string> languages;
    std::vector<std::string> captions;  ///< LANGUAGE=TEXT
    std::vector<PackCaption> described; ///< of both, for each language
};

Result<void> describe(Pack& pack, const Arguments& arguments) {
    pack.title = arguments.title;
    pack.captions = arguments.described;
    for (const PackCaption& caption : pack.captions) {
        pack.languages.push_back(caption.language);
    }
    const Result<Bytes> source = read_file(arguments.input);
    if (!source) {
        return tl::unexpected<Error>(source.error());
    }
    pack.provenance.source_name = arguments.input.filename().string();
    pack.provenance.source_sha256 = sha256_hex(*source);
    pack.provenance.licence = arguments.licence;
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
Result<void> tell(const std::vector<SourceNote>& notes, const Arguments& arguments) {
    std::vector<std::string> lost;
    for (const SourceNote& note : notes) {
        if (note.kind == SourceNote::Kind::Lost) {
            lost.push_back(note.text);
        }
    }
    if (arguments.strict && !lost.empty()) {
        return bad_input(fmt::format("{}: this would be lost, and --strict forbids it: {}",
                                     arguments.input.string(), fmt::join(lost, "; ")));
    }
    for (const std::string& text : lost) {
        say_line("frustumscreen-bake", fmt::format("{}: lost: {}", arguments.input.string(), text));
    }
    return {};
}

/// Reads the file and says what is lost of it.
Result<SourceMesh> load(const Arguments& arguments) {
    Result<SourceMesh> mesh = load_mesh(arguments.input, {arguments.texture});
    if (!mesh) {
        return mesh;
    }
    if (const Result<void> safe = check_output_is_no_input(arguments.output, mesh->side_files); !safe) {
        return tl::unexpected<Error>(safe.error());
    }
    if (arguments.options.unlit && !has_colours(*mesh)) {
        mesh->notes.push_back(
            {SourceNote::Kind::Lost,
             "the relief: the file has no colours, and --unlit makes a flat picture of it; without "
             "--unlit it is lit as in a museum"});
    }
    if (const Result<void> told = tell(mesh->notes, arguments); !told) {
        return tl::unexpected<Error>(told.error());
    }
    return mesh;
}

Result<BakeResult> bake_file(const Arguments& arguments, BakeOptions options) {
    const auto start = std::chrono::steady_clock::now();
    const Result<SourceMesh> mesh = load(arguments);
    if (!mesh) {
        return tl::unexpected<Error>(mesh.error());
    }
    BakeResult result;
    result.file = arguments.output;
    result.prop = options.prop;
    result.notes = mesh->notes;
    result.up = options.up.empty() ? std::string(1, mesh->default_up) : options.up;
    result.up_given = !options.up.empty();
    result.turn_given = arguments.turn_deg.has_value();
    options.turn_deg = result.turn_deg =
        arguments.turn_deg ? *arguments.turn_deg
                           : best_turn_deg(*mesh, result.up, options.lift, options.prop.shape);
    Result<Pack> pack = bake(*mesh, options);
    if (!pack) {
        return at(arguments.input.string(), pack.error());
    }
    if (const Result<void> described = describe(*pack, arguments); !described) {
        return tl::unexpected<Error>(described.error());
    }
    result.pack = *std::move(pack);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

/// Checks before the work that no scan and no unknown file is overwritten, and that the pack can be written.
Result<void> check_output(const Arguments& arguments) {
    if (Result<void> safe = check_output_is_no_input(arguments.output, {{arguments.input}}); !safe) {
        return safe;
    }
    if (Result<void> place = check_output_place(arguments.output, room_for_pack(arguments.options.size));
        !place) {
        return place;
    }
    std::error_code ignored;
    if (!arguments.force && std::filesystem::exists(arguments.output, ignored) &&
        !begins_as_pack(arguments.output)) {
        return bad_input(fmt::format("{}: this file is there and is not a pack; choose another name for the "
                                     "output, or add --force to replace it",
                                     arguments.output.string()));
    }
    return {};
}

Result<BakeResult> work(const Arguments& arguments) {
    if (Result<void> checked = check_output(arguments); !checked) {
        return tl::unexpected<Error>(checked.error());
    }
    ProgressLine progress("baking: ");
    BakeOptions options = arguments.options;
    options.progress = [&](std::string_view step, double done) { progress.show_share(step, done); };
    Result<BakeResult> result = bake_file(arguments, std::move(options));
    if (!result) {
        return result;
    }
    const Result<Bytes> bytes = write_pack(result->pack);
    if (!bytes) {
        return at(arguments.output.string(), bytes.error());
    }
    Result<std::vector<PackPart>> parts = list_pack_parts(*bytes);
    if (!parts) {
        return at(arguments.output.string(), parts.error());
    }
    result->parts = *std::move(parts);
    result->file_bytes = bytes->size();
    if (const Result<void> written = write_file(arguments.output, *bytes); !written) {
        return tl::unexpected<Error>(written.error());
    }
    return result;
}

int run(int argc, char** argv) {
    if (asks_for_words(argc, argv)) {
        return words_command(argc, argv);
    }
    Arguments arguments;

    CLI::App app("Bakes an artifact (glTF, OBJ, PLY, STL) into a pack for the FrustumScreen.",
                 "frustumscreen-bake");
    app.set_version_flag("--version", FRUSTUMSCREEN_VERSION);
    app.footer("frustumscreen-bake --words bakes the exhibit's own words instead; --words --help says more.");
    app.add_option("INPUT", arguments.input, "artifact file")->required();
    app.add_option("-o,--output", arguments.output, "pack to write (*.fspack)")->required();
    app.add_flag("--force", arguments.force, "replace the output also if it is not a pack");
    app.add_option("--size", arguments.options.size, "texels along the longest edge of a face, 16 to 4096")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    app.add_flag("--unlit", arguments.options.unlit,
                 "base colour alone, no museum light: for colours that already contain light");
    app.add_option("--prop", arguments.prop, "prop whose directions the relief is made for")
        ->check(CLI::IsMember({"frustum", "cube"}))
        ->capture_default_str();
    app.add_option("--up", arguments.options.up, "the file's up axis (default: glTF, OBJ, PLY y; STL z)")
        ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
    app.add_option(
           "--turn", arguments.turn_deg,
           "degrees about the vertical axis, counter-clockwise seen from above; 0 = as the file has it "
           "(default: the largest size and the best side)")
        ->check(CLI::Range(-360.0, 360.0));
    app.add_option("--scale", arguments.options.scale,
                   "factor on the largest size that fits into the prop; above 1 the prop cuts it off")
        ->check(CLI::Range(0.05, 20.0))
        ->capture_default_str();
    app.add_option("--lift", arguments.options.lift,
                   "raises the artifact above the prop's bottom, in heights of the artifact, 0 to 1")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    app.add_option("--texture", arguments.texture,
                   "picture of the colours, where the file names one that is missing, or none");
    app.add_flag("--strict", arguments.strict,
                 "refuse a file of which something would be lost; nothing is written");
    app.add_flag("--json", arguments.json, "the report for programs");
    app.add_option("--title", arguments.title, "title (default: the file's name)");
    app.add_option("--language", arguments.languages, "language of a caption, BCP 47; once for each");
    app.add_option("--caption", arguments.captions, "LANGUAGE=TEXT; once for each language");
    app.add_option("--licence", arguments.licence, "licence of the artifact");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    arguments.title = arguments.title.empty() ? arguments.input.stem().string() : arguments.title;
    Result<std::vector<PackCaption>> captions =
        captions_of(arguments.title, arguments.languages, arguments.captions);
    if (!captions) {
        fmt::print(stderr, "frustumscreen-bake: {}\n", captions.error().message);
        return 2;
    }
    arguments.described = std::move(*captions);
    arguments.options.prop = arguments.prop == "cube" ? baked_cube() : baked_frustum();
    try {
        const Result<BakeResult> done = work(arguments);
        if (!done) {
            fmt::print(stderr, "frustumscreen-bake: {}\n", done.error().message);
            return 1;
        }
        fmt::print("{}", arguments.json ? report_json(*done).dump(2) + "\n" : report_text(*done));
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "frustumscreen-bake: {}: not enough memory; try a smaller --size\n",
                   arguments.input.string());
        return 1;
    }
    return 0;
}

} // namespace
} // namespace frustumscreen

int main(int argc, char** argv) {
    return frustumscreen::guarded_main("frustumscreen-bake", frustumscreen::run, argc, argv);
}
